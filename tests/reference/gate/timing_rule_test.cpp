// When a ratio of times is beyond its limit.
#include "reference/gate/timing_rule.h"

#include <gmock/gmock.h>

#include <cmath>

namespace contactcheck::gate {
namespace {

constexpr TimingTolerance kTolerance{10.0, 0.1};  // 10 us, 10 %

TEST(Slowness, BeyondTheLimitWithItsWholeIntervalFails) {
  const TimingVerdict verdict = judge_slowness({{1.25, 1.2, 1.3}, 100.0, 5}, kTolerance);
  EXPECT_EQ(verdict.verdict, Verdict::kFail);
  EXPECT_DOUBLE_EQ(verdict.excess_us, 20.0);  // of 100 us, 80 are allowed
  EXPECT_EQ(verdict.reason, "20 us too long per frame of 100 us");
}

TEST(Slowness, BelowTheFloorPasses) {
  const TimingVerdict verdict = judge_slowness({{1.25, 1.2, 1.3}, 49.0, 5}, kTolerance);
  EXPECT_EQ(verdict.verdict, Verdict::kPass);
  EXPECT_DOUBLE_EQ(verdict.excess_us, 9.8);
  EXPECT_EQ(verdict.reason, "beyond the limit by 9.8 us per frame, less than 10 us");
}

TEST(Slowness, AtTheFloorFails) {
  EXPECT_EQ(judge_slowness({{2.0, 1.5, 3.0}, 20.0, 5}, kTolerance).verdict, Verdict::kFail);
}

TEST(Slowness, WithTheLimitInsideANarrowIntervalPasses) {
  const TimingVerdict verdict = judge_slowness({{1.02, 0.98, 1.05}, 1e6, 5}, kTolerance);
  EXPECT_EQ(verdict.verdict, Verdict::kPass);
  EXPECT_EQ(verdict.reason, "");
}

TEST(Slowness, WithTheLimitInsideAWideIntervalIsTooNoisy) {
  const TimingVerdict verdict = judge_slowness({{0.9, 0.8, 1.2}, 1e6, 5}, kTolerance);
  EXPECT_EQ(verdict.verdict, Verdict::kTooNoisy);
  EXPECT_EQ(verdict.reason, "the limit lies inside the 95 % interval, whose ends are 1.5x apart");
}

TEST(Slowness, OfAWideIntervalOnTheGoodSidePasses) {
  EXPECT_EQ(judge_slowness({{0.6, 0.3, 1.0}, 1e6, 5}, kTolerance).verdict, Verdict::kPass);
}

TEST(Slowness, OfAWideIntervalOnTheBadSideFails) {
  EXPECT_EQ(judge_slowness({{3.0, 1.01, 9.0}, 1e6, 5}, kTolerance).verdict, Verdict::kFail);
}

TEST(Slowness, OfARangeFailsBeyondTheFactorAlone) {
  const auto verdict = [](double low, double high) {
    return judge_slowness({{std::sqrt(low * high), low, high}, 100.0, 4}, kTolerance).verdict;
  };
  EXPECT_EQ(verdict(1.51, 1.6), Verdict::kFail);
  EXPECT_EQ(verdict(1.5, 9.0), Verdict::kCannotJudge);
  EXPECT_EQ(verdict(0.99, 1.01), Verdict::kCannotJudge) << "however narrow it is";
  EXPECT_EQ(verdict(0.1, 0.67), Verdict::kCannotJudge);
  EXPECT_EQ(verdict(0.5, 0.66), Verdict::kPass);
}

TEST(Slowness, OfARangeBelowTheFloorPasses) {
  EXPECT_EQ(judge_slowness({{1.0, 0.1, 9.0}, 9.0, 3}, kTolerance).verdict, Verdict::kPass)
      << "the whole frame is shorter";
  const TimingVerdict verdict = judge_slowness({{2.0, 1.8, 2.2}, 19.0, 3}, kTolerance);
  EXPECT_EQ(verdict.verdict, Verdict::kPass);
  EXPECT_EQ(verdict.reason, "beyond the limit by 9.5 us per frame, less than 10 us");
}

TEST(Slowness, OfASpeedUpTurnsItsIntervalRound) {
  const results::Ratio r = slowness_of({4.0, 2.0, 8.0}, 6.0);
  EXPECT_DOUBLE_EQ(r.value, 1.5);
  EXPECT_DOUBLE_EQ(r.low, 0.75);
  EXPECT_DOUBLE_EQ(r.high, 3.0);
}

TEST(Slowness, OfASpeedUpOfNothingHasNoEnd) {
  const results::Ratio r = slowness_of({0.0, 0.0, 0.0}, 6.0);
  EXPECT_TRUE(std::isinf(r.low));
  EXPECT_EQ(judge_slowness({r, 100.0, 5}, kTolerance).verdict, Verdict::kFail);
}

TEST(Slowdown, OverItsLimitIsASlowness) {
  const results::Ratio r = over_limit({2.2, 1.1, 3.3}, 1.1);
  EXPECT_DOUBLE_EQ(r.value, 2.0);
  EXPECT_DOUBLE_EQ(r.low, 1.0);
  EXPECT_DOUBLE_EQ(r.high, 3.0);
}

}  // namespace
}  // namespace contactcheck::gate
