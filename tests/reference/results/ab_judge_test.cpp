#include "reference/results/ab.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "tests/reference/results/rounds.h"

namespace contactcheck::results {
namespace {

using test::rounds_of;
using test::steady_rounds;
using test::timed_run;
using testing::ElementsAre;
using testing::IsEmpty;

AbVerdict verdict(const std::vector<AbRound>& rounds, const AbLimits& limits = {}) {
  return judge_ab(rounds, limits).times.at(0).verdict;
}

TEST(AbJudge, ThirtyPercentSlowerFails) {
  const AbJudgement judgement = judge_ab(steady_rounds(1.0, 1.3), {});
  EXPECT_TRUE(judgement.slower());
  EXPECT_NEAR(judgement.times.at(0).ratio.value, 1.3, 1e-12);
  EXPECT_EQ(judgement.times.at(0).base_ms, 1.0);
  EXPECT_NEAR(judgement.times.at(0).head_ms, 1.3, 1e-12);
  EXPECT_FALSE(judgement.answers_differ());
}

TEST(AbJudge, WithinTheLimitPasses) {
  EXPECT_EQ(verdict(steady_rounds(1.0, 1.05)), AbVerdict::kPass);
  EXPECT_EQ(verdict(steady_rounds(1.0, 0.5)), AbVerdict::kPass);
  EXPECT_EQ(verdict(steady_rounds(1.0, 1.3), {1.5, 20.0}), AbVerdict::kPass);
}

TEST(AbJudge, ExcessBelowTheFloorPassesWhateverTheRatio) {
  EXPECT_EQ(verdict(steady_rounds(0.010, 0.025)), AbVerdict::kPass) << "15 us";
  EXPECT_EQ(verdict(steady_rounds(0.010, 0.035)), AbVerdict::kSlower) << "25 us";
  EXPECT_EQ(verdict(steady_rounds(0.010, 0.025), {1.1, 5.0}), AbVerdict::kSlower);
}

TEST(AbJudge, WideIntervalAboutTheLimitIsTooNoisy) {
  const std::vector<double> base(7, 1.0);
  EXPECT_EQ(verdict(rounds_of(base, {0.7, 0.8, 0.9, 1.2, 1.5, 1.6, 1.7})), AbVerdict::kTooNoisy);
  EXPECT_EQ(verdict(rounds_of(base, {1.05, 1.07, 1.08, 1.09, 1.11, 1.12, 1.13})), AbVerdict::kPass)
      << "narrow, and not shown to be beyond the limit";
  EXPECT_EQ(verdict(rounds_of(base, {0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0})), AbVerdict::kPass)
      << "wide, but below the limit";
  EXPECT_EQ(verdict(rounds_of(std::vector<double>(7, 0.010),
                              {0.007, 0.008, 0.009, 0.012, 0.015, 0.016, 0.017})),
            AbVerdict::kPass)
      << "wide, but below the floor";
}

TEST(AbJudge, RatioIsTheGeometricMeanOverRounds) {
  const AbTime time =
      judge_ab(rounds_of({1.0, 2.0, 4.0, 8.0, 1.0}, {1.0, 4.0, 16.0, 16.0, 4.0}), {}).times.at(0);
  const Ratio expected = mean_ratio({1.0, 2.0, 4.0, 2.0, 4.0});
  EXPECT_EQ(time.ratio.value, expected.value);
  EXPECT_EQ(time.ratio.low, expected.low);
  EXPECT_EQ(time.ratio.high, expected.high);
  EXPECT_NEAR(time.base_ms, std::pow(2.0, 6.0 / 5.0), 1e-12);
  EXPECT_NEAR(time.head_ms, std::pow(2.0, 12.0 / 5.0), 1e-12);
}

// Noise of one run is lognormal; every round has a drift that both builds share, and some runs are
// twice as slow.
class NoisyMachine {
 public:
  explicit NoisyMachine(double sigma, double slow_runs = 0.05)
      : sigma_(sigma), slow_runs_(slow_runs) {}

  std::vector<AbRound> rounds(double factor, std::size_t number = 7) {
    std::vector<double> base, head;
    for (std::size_t i = 0; i < number; ++i) {
      const double drift = std::exp(0.3 * normal());
      base.push_back(drift * run());
      head.push_back(drift * factor * run());
    }
    return rounds_of(base, head);
  }

  // Of 200 comparisons.
  double share_of_slower(double factor) {
    int slower = 0;
    for (int i = 0; i < 200; ++i) slower += judge_ab(rounds(factor), {}).slower() ? 1 : 0;
    return slower / 200.0;
  }
  double share_of_passes(double factor) {
    int passes = 0;
    for (int i = 0; i < 200; ++i) passes += verdict(rounds(factor)) == AbVerdict::kPass ? 1 : 0;
    return passes / 200.0;
  }

 private:
  double uniform() { return (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53; }
  double normal() {
    return std::sqrt(-2.0 * std::log(uniform())) * std::cos(6.283185307179586 * uniform());
  }
  double run() { return std::exp(sigma_ * normal()) * (uniform() < slow_runs_ ? 2.0 : 1.0); }

  double sigma_, slow_runs_;
  std::mt19937_64 random_{7};
};

TEST(AbJudge, NoiseAloneRaisesNoAlarm) {
  EXPECT_EQ(NoisyMachine(0.02).share_of_slower(1.0), 0.0);
  EXPECT_LE(NoisyMachine(0.10).share_of_slower(1.0), 0.02);
}

TEST(AbJudge, ThirtyPercentAreFoundOnANoisyMachine) {
  EXPECT_GE(NoisyMachine(0.02, 0.0).share_of_slower(1.3), 0.99);
  EXPECT_GE(NoisyMachine(0.05, 0.0).share_of_slower(1.3), 0.95);
}

// A mean takes every round in: where one in twenty is twice as slow, three comparisons in ten
// cannot be judged. None of them passes.
TEST(AbJudge, ThirtyPercentAreFoundOrTooNoisyWhereSomeRunsAreTwiceAsSlow) {
  for (const double sigma : {0.02, 0.05}) {
    EXPECT_GE(NoisyMachine(sigma).share_of_slower(1.3), 0.55) << sigma;
    EXPECT_EQ(NoisyMachine(sigma).share_of_passes(1.3), 0.0) << sigma;
  }
}

TEST(AbJudge, OtherAnswersAreNamedAndTimesAreStillJudged) {
  auto rounds = steady_rounds(1.0, 1.0);
  for (AbRound& round : rounds) round.head.runs[0].contact_hash = "0x2";
  const AbJudgement judgement = judge_ab(rounds, {});
  EXPECT_TRUE(judgement.answers_differ());
  ASSERT_EQ(judgement.answers.size(), 1u);
  EXPECT_THAT(judgement.answers[0].what, ElementsAre("contact hash 0x1 -> 0x2"));
  EXPECT_THAT(judgement.unsteady, IsEmpty());
  EXPECT_EQ(judgement.times.size(), 1u);
}

TEST(AbJudge, BuildThatContradictsItselfIsNamedOnce) {
  auto rounds = steady_rounds(1.0, 1.0);
  rounds[2].head.runs[0].contact_hash = "0x2";
  rounds[5].head.runs[0].contact_hash = "0x3";
  const AbJudgement judgement = judge_ab(rounds, {});
  EXPECT_THAT(judgement.answers, IsEmpty());
  ASSERT_EQ(judgement.unsteady.size(), 1u);
  EXPECT_EQ(judgement.unsteady[0].detector, "d in head");
  EXPECT_TRUE(judgement.answers_differ());
}

TEST(AbJudge, WhatOneSideLacksIsNamed) {
  auto rounds = steady_rounds(1.0, 1.0);
  for (AbRound& round : rounds) {
    round.head.runs.push_back(timed_run("s", "new", 1.0));
    round.base.runs.push_back(timed_run("old", "d", 1.0));
  }
  const AbJudgement judgement = judge_ab(rounds, {});
  EXPECT_THAT(judgement.only_head, ElementsAre("detector new (in 1 scene)"));
  EXPECT_THAT(judgement.only_base, ElementsAre("scene old (1 detector)"));
  EXPECT_EQ(judgement.times.size(), 1u);
  EXPECT_EQ(judgement.untimed, 0u);
}

TEST(AbJudge, RowWithoutATimeInSomeRoundIsNotJudged) {
  auto rounds = steady_rounds(1.0, 2.0);
  rounds[3].head.runs[0].times.clear();
  const AbJudgement judgement = judge_ab(rounds, {});
  EXPECT_THAT(judgement.times, IsEmpty());
  EXPECT_EQ(judgement.untimed, 1u);
}

TEST(AbJudge, OtherQuestionsAreNotCompared) {
  auto rounds = steady_rounds(1.0, 2.0);
  for (AbRound& round : rounds) round.head.runs[0].times[0].question = Question::kBody;
  EXPECT_THAT(judge_ab(rounds, {}).times, IsEmpty());
}

TEST(AbJudge, SlowestComesFirst) {
  auto rounds = steady_rounds(1.0, 1.2);
  for (AbRound& round : rounds) {
    round.base.runs.push_back(timed_run("s", "e", 1.0));
    round.head.runs.push_back(timed_run("s", "e", 1.5));
  }
  EXPECT_EQ(judge_ab(rounds, {}).times.at(0).detector, "e");
}

}  // namespace
}  // namespace contactcheck::results
