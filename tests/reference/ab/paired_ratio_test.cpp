#include "reference/ab/paired_ratio.h"

#include <gtest/gtest.h>

namespace contactcheck {
namespace {

TEST(PairedRatio, OfConstantTimesIsExact) {
  const RatioInterval ratio = paired_ratio({2.0, 2.0, 2.0}, {3.0, 3.0, 3.0});
  EXPECT_EQ(ratio.value, 1.5);
  EXPECT_EQ(ratio.low, 1.5);
  EXPECT_EQ(ratio.high, 1.5);
}

// A machine that throttles slows both builds of a round.
TEST(PairedRatio, DriftOfBothIsNoChange) {
  const std::vector<double> drifting = {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0};
  const RatioInterval ratio = paired_ratio(drifting, drifting);
  EXPECT_EQ(ratio.low, 1.0);
  EXPECT_EQ(ratio.high, 1.0);
}

TEST(PairedRatio, OneSlowRoundDoesNotMoveTheMedian) {
  const RatioInterval ratio =
      paired_ratio({1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0}, {1.0, 1.0, 1.0, 9.0, 1.0, 1.0, 1.0});
  EXPECT_EQ(ratio.value, 1.0);
  EXPECT_EQ(ratio.high, 1.0);
}

TEST(PairedRatio, IntervalHoldsTheRatioAndWidensWithTheSpread) {
  const RatioInterval ratio = paired_ratio({1.0, 1.0, 1.0, 1.0, 1.0}, {0.8, 0.9, 1.0, 1.1, 1.2});
  EXPECT_EQ(ratio.value, 1.0);
  EXPECT_GE(ratio.low, 0.8);
  EXPECT_LT(ratio.low, 1.0);
  EXPECT_LE(ratio.high, 1.2);
  EXPECT_GT(ratio.high, 1.0);
}

TEST(PairedRatio, OfAnEvenNumberOfRoundsIsTheMiddle) {
  EXPECT_EQ(paired_ratio({1.0, 1.0, 1.0, 1.0}, {1.0, 2.0, 3.0, 9.0}).value, 2.5);
}

}  // namespace
}  // namespace contactcheck
