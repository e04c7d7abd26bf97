#include "reference/diff/ratio_interval.h"

#include <gtest/gtest.h>

#include <cmath>

namespace contactcheck {
namespace {

TEST(Quotient, CombinesTheIntervalsAsIndependentErrors) {
  // Of exp(3) and exp(4) to either side: sqrt(9 + 16) = 5 in the log domain.
  const RatioInterval now = {2.0, 2.0 * std::exp(-3.0), 2.0 * std::exp(3.0)},
                      then = {4.0, 4.0 * std::exp(-4.0), 4.0 * std::exp(4.0)};
  const RatioInterval factor = quotient(now, then);
  EXPECT_DOUBLE_EQ(factor.value, 0.5);
  EXPECT_NEAR(factor.low, 0.5 * std::exp(-5.0), 1e-12);
  EXPECT_NEAR(factor.high, 0.5 * std::exp(5.0), 1e-9);
}

TEST(Quotient, LowerEndComesFromTheLowEndNowAndTheHighEndThen) {
  const RatioInterval factor = quotient({1.0, 0.5, 1.0}, {1.0, 1.0, 1.0});
  EXPECT_DOUBLE_EQ(factor.low, 0.5);
  EXPECT_DOUBLE_EQ(factor.high, 1.0);
  EXPECT_DOUBLE_EQ(quotient({1.0, 1.0, 1.0}, {1.0, 1.0, 2.0}).low, 0.5);
}

TEST(Quotient, OfSmallIntervalsIsTheSame) {
  const double e = std::exp(0.01);
  // Half-widths of 3 % and 4 %, as logarithms: 5 % together.
  const RatioInterval before{8.0, 8.0 / std::pow(e, 3), 8.0 * std::pow(e, 3)};
  const RatioInterval now{4.0, 4.0 / std::pow(e, 4), 4.0 * std::pow(e, 4)};
  const RatioInterval r = quotient(before, now);
  EXPECT_DOUBLE_EQ(r.value, 2.0);
  EXPECT_NEAR(r.low, 2.0 / std::pow(e, 5), 1e-12);
  EXPECT_NEAR(r.high, 2.0 * std::pow(e, 5), 1e-12);
}

TEST(Quotient, TakesEitherEndFromTheEndsThatMoveItThere) {
  const double e = std::exp(0.01);
  // It was perhaps less fast, it may be faster now: both make the slow-down smaller.
  const RatioInterval r =
      quotient({8.0, 8.0 / std::pow(e, 3), 8.0}, {4.0, 4.0, 4.0 * std::pow(e, 4)});
  EXPECT_NEAR(r.low, 2.0 / std::pow(e, 5), 1e-12);
  EXPECT_DOUBLE_EQ(r.high, 2.0);
}

}  // namespace
}  // namespace contactcheck
