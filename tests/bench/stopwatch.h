#pragma once

#include <benchmark/benchmark.h>

#include <chrono>

namespace contactcheck::bench {

/// For benchmarks whose iterations have parts that do not count (UseManualTime): cheaper than
/// pausing the library's own clock.
template <typename Work>
double seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  benchmark::ClobberMemory();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace contactcheck::bench
