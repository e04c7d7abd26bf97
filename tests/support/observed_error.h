// The largest error that a search finds, over the bound that is proved for it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace contactcheck::test {

/// Prints and records it. A bound that is too small fails. So does one of which the search sees no
/// more than `at_least`: the search would not notice a bound that many times smaller.
inline void report_observed_error(const std::string& of, double ratio, double at_least) {
  std::printf("largest observed error / bound, %s: %.3f\n", of.c_str(), ratio);
  ::testing::Test::RecordProperty(of, std::to_string(ratio));
  EXPECT_LE(ratio, 1.0) << of;
  EXPECT_GT(ratio, at_least) << of;
}
inline constexpr double kSixteenth = 1.0 / 16;

/// The largest value of `error_of(x)` from `starts` random points, each improved by `steps` random
/// changes of which those are kept that lose nothing.
template <typename Make, typename Change, typename ErrorOf>
double climb(int starts, int steps, Make&& make, Change&& change, ErrorOf&& error_of) {
  double largest = 0.0;
  for (int start = 0; start < starts; ++start) {
    auto best = make();
    double error = error_of(best);
    for (int step = 0; step < steps; ++step) {
      auto next = best;
      change(next);
      const double changed = error_of(next);
      if (changed >= error) best = next, error = changed;
    }
    largest = std::max(largest, error);
  }
  return largest;
}

}  // namespace contactcheck::test
