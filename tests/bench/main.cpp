// contactcheck_bench: Google Benchmark's options apply, e.g. --benchmark_filter=mapping.
// Times of a shared machine mean little by themselves: compare within one run.

#include <benchmark/benchmark.h>

#include "tests/bench/register.h"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  contactcheck::bench::register_mapping_benchmarks();
  contactcheck::bench::register_narrow_benchmarks();
  contactcheck::bench::register_broad_benchmarks();
  contactcheck::bench::register_lazy_benchmarks();
  contactcheck::bench::register_pipeline_benchmarks();
  contactcheck::bench::register_oracle_benchmarks();
  contactcheck::bench::register_supervision_benchmarks();
#ifdef CONTACTCHECK_BENCH_PYTHON
  contactcheck::bench::register_python_benchmarks();
#endif
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
