// Costs beside an anchor, of hand-made samples.
#include "reference/tune/paired_cost.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace contactcheck {
namespace {

// Three frames of five repeats: the detector costs twice the anchor, which takes 10, 20 and 30.
PairedRun twice() {
  PairedRun run;
  for (std::size_t f = 0; f < 3; ++f)
    for (int r = 0; r < 5; ++r) {
      const double anchor = 10.0 * static_cast<double>(f + 1) + 0.1 * r;
      run[f].anchor.push_back(anchor);
      run[f].own.push_back(2.0 * anchor);
    }
  return run;
}

TEST(PairedCost, IsTheQuotient) {
  const Ratio cost = relative_cost({twice()});
  EXPECT_NEAR(cost.ratio, 2.0, 1e-12);
  EXPECT_NEAR(cost.low, 2.0, 1e-12);
  EXPECT_NEAR(cost.high, 2.0, 1e-12);
}

TEST(PairedCost, IsWeightedByWhatTheAnchorTakes) {
  PairedRun run = twice();
  for (double& own : run[2].own) own *= 2.0;  // half of the anchor's time, four times the cost
  EXPECT_NEAR(relative_cost({run}).ratio, 0.5 * 2.0 + 0.5 * 4.0, 1e-2);
}

TEST(PairedCost, PassesOverPreemptionsOfEitherSide) {
  PairedRun run = twice();
  for (std::size_t f = 0; f < 3; ++f) {
    run[f].own[f] += 4000.0;
    run[f].anchor[f + 1] += 4000.0;
    run[f].anchor[f + 2] += 4000.0;
    run[f].own[(f + 4) % 5] += 4000.0;
  }
  EXPECT_NEAR(relative_cost({run}).ratio, 2.0, 1e-12);
}

TEST(PairedCost, KnowsNothingOfAMachineThatSlowsDown) {
  PairedRun run = twice();
  for (auto& [frame, pairs] : run)
    for (std::size_t r = 2; r < 5; ++r) {
      pairs.own[r] *= 3.0;
      pairs.anchor[r] *= 3.0;
    }
  EXPECT_NEAR(relative_cost({run}).ratio, 2.0, 1e-12);
}

TEST(PairedCost, OfOneRepeatHasAnIntervalStill) {
  PairedRun run;
  for (std::size_t f = 0; f < 9; ++f) run[f] = {{f % 3 == 0 ? 30.0 : 10.0}, {10.0}};
  const Ratio cost = relative_cost({run});
  EXPECT_LT(cost.low, cost.ratio);
  EXPECT_GT(cost.high, cost.ratio);
}

TEST(PairedCost, OfOnePairMightBeAnything) {
  const PairedRun run = {{0, {{30.0}, {10.0}}}}, other = {{0, {{20.0}, {10.0}}}};
  const Ratio cost = relative_cost({run});
  EXPECT_NEAR(cost.ratio, 3.0, 1e-12);
  EXPECT_EQ(cost.low, 0.0);
  EXPECT_EQ(cost.high, std::numeric_limits<double>::infinity());
  EXPECT_EQ(product({2.0, 1.0, 3.0}, cost).low, 0.0);
  EXPECT_EQ(product({2.0, 1.0, 3.0}, cost).high, cost.high);
  EXPECT_LE(relative_cost({run, other}).high, 3.0) << "two of them show how far they are apart";
}

TEST(PairedCost, OfMoreRunsIsNarrower) {
  PairedRun run = twice();
  for (auto& [frame, pairs] : run)
    for (std::size_t r = 0; r < 5; ++r) pairs.own[r] *= 1.0 + 0.1 * static_cast<double>(r);
  const Ratio once = relative_cost({run}), often = relative_cost({run, run, run, run});
  EXPECT_NEAR(often.ratio, once.ratio, 1e-12);
  EXPECT_LT(often.high - often.low, 0.8 * (once.high - once.low));
}

TEST(PairedCost, OfRunsThatTimedDifferentFramesIsThatOfTheSharedOnes) {
  PairedRun less = twice();
  less.erase(2);
  PairedRun more = twice();
  for (double& own : more[2].own) own *= 100.0;
  EXPECT_NEAR(relative_cost({more, less}).ratio, 2.0, 1e-12);
}

TEST(PairUp, TakesTheFramesAndRepeatsThatBothHave) {
  QuestionSamples own, anchor;
  own.frames[3].cold = {{1.0, 2.0, 3.0}, {1.0, 1.0, 1.0}};
  own.frames[4].cold = {{1.0, 1.0, 1.0}};
  anchor.frames[3].cold = {{0.0, 0.0, 0.0}};  // the clock did not tick
  const PairedRun run = pair_up({own}, {anchor});
  ASSERT_EQ(run.size(), 1u);
  EXPECT_EQ(run.at(3).own, std::vector<double>{6.0});
  EXPECT_EQ(run.at(3).anchor, std::vector<double>{1.0});
}

TEST(MiddleOf, IsTheMedianAndGetsNarrowerWithRuns) {
  const Ratio one{0.5, 0.4, 0.625};
  const Ratio odd{5.0, 4.0, 6.25};
  EXPECT_NEAR(middle_of({one}).low, 0.4, 1e-12);
  EXPECT_EQ(middle_of({one, odd, one}).ratio, 0.5);
  EXPECT_GT(middle_of({one, odd, one}).high, one.high) << "runs that disagree";
  EXPECT_LT(middle_of({one, one, one, one}).high, 0.99 * one.high);
  EXPECT_GT(middle_of({one, one, one, one}).high, 0.5 * std::sqrt(1.25)) << "a median, no mean";
}

TEST(MiddleOf, OfOneRunIsThatRun) {
  const Ratio r = middle_of({{1.0, 1.0, 1.5}});
  EXPECT_EQ(r.low, 1.0);
  EXPECT_EQ(r.high, 1.5);
}

TEST(MiddleOf, KeepsWhatIsKnownBelowApartFromWhatIsKnownAbove) {
  const Ratio lopsided{1.0, 1.0, 1.5};
  const Ratio r = middle_of({lopsided, lopsided});
  EXPECT_NEAR(r.low, 1.0, 1e-12);
  EXPECT_NEAR(r.high, std::pow(1.5, 1.2533 / std::sqrt(2.0)), 1e-12);
}

// Runs whose speeds differ by 3 %, of which each knows its own ratio as well as it may.
double coverage(std::size_t runs, double known) {
  constexpr int kTrials = 4000;
  constexpr double kTrue = 0.5, kApart = 0.03;
  std::mt19937_64 random(runs);
  std::normal_distribution<double> normal(0.0, kApart);
  int covered = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<Ratio> all;
    for (std::size_t i = 0; i < runs; ++i) {
      const double ratio = kTrue * std::exp(normal(random));
      all.push_back({ratio, ratio / (1.0 + known), ratio * (1.0 + known)});
    }
    const Ratio middle = middle_of(all);
    covered += middle.low <= kTrue && kTrue <= middle.high;
  }
  return static_cast<double>(covered) / kTrials;
}

TEST(MiddleOf, CoversTheTruthAsOftenAsItSays) {
  for (const std::size_t runs : {2u, 3u, 4u, 5u, 6u, 9u, 16u})
    for (const double known : {0.0, 0.01, 0.06}) {
      EXPECT_GE(coverage(runs, known), 0.94) << runs << " runs, each known to " << known;
    }
}

TEST(Product, IsAsUncertainAsBothTogether) {
  const Ratio r = product({2.0, 2.0, 2.0}, {3.0, 1.5, 4.0});
  EXPECT_NEAR(r.ratio, 6.0, 1e-12);
  EXPECT_NEAR(r.low, 3.0, 1e-12);
  EXPECT_NEAR(r.high, 8.0, 1e-12);
  const Ratio both = product({1.0, 0.5, 2.0}, {1.0, 0.5, 2.0});
  EXPECT_NEAR(both.high, std::pow(2.0, std::sqrt(2.0)), 1e-12);
}

}  // namespace
}  // namespace contactcheck
