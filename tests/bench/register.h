// One function per file of benchmarks; main.cpp calls them all.
#pragma once

namespace contactcheck::bench {

void register_mapping_benchmarks();
void register_narrow_benchmarks();
void register_broad_benchmarks();
void register_lazy_benchmarks();
void register_pipeline_benchmarks();
void register_oracle_benchmarks();
void register_supervision_benchmarks();
void register_python_benchmarks();

}  // namespace contactcheck::bench
