// Costs beside an anchor, of hand-made samples.
#include "reference/tune/paired_cost.h"

#include <gtest/gtest.h>

#include <limits>

namespace contactcheck::tune {
namespace {

// Three frames of five passes: the detector costs twice the anchor, which takes 10, 20 and 30.
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
  const results::Ratio cost = relative_cost({twice()});
  EXPECT_NEAR(cost.value, 2.0, 1e-12);
  EXPECT_NEAR(cost.low, 2.0, 1e-12);
  EXPECT_NEAR(cost.high, 2.0, 1e-12);
}

TEST(PairedCost, IsWeightedByWhatTheAnchorTakes) {
  PairedRun run = twice();
  for (double& own : run[2].own) own *= 2.0;  // half of the anchor's time, four times the cost
  EXPECT_NEAR(relative_cost({run}).value, 0.5 * 2.0 + 0.5 * 4.0, 1e-2);
}

TEST(PairedCost, PassesOverPreemptionsOfEitherSide) {
  PairedRun run = twice();
  for (std::size_t f = 0; f < 3; ++f) {
    run[f].own[f] += 4000.0;
    run[f].anchor[f + 1] += 4000.0;
    run[f].anchor[f + 2] += 4000.0;
    run[f].own[(f + 4) % 5] += 4000.0;
  }
  EXPECT_NEAR(relative_cost({run}).value, 2.0, 1e-12);
}

TEST(PairedCost, KnowsNothingOfAMachineThatSlowsDown) {
  PairedRun run = twice();
  for (auto& [frame, pairs] : run)
    for (std::size_t r = 2; r < 5; ++r) {
      pairs.own[r] *= 3.0;
      pairs.anchor[r] *= 3.0;
    }
  EXPECT_NEAR(relative_cost({run}).value, 2.0, 1e-12);
}

TEST(PairedCost, OfOnePassHasAnIntervalStill) {
  PairedRun run;
  for (std::size_t f = 0; f < 9; ++f) run[f] = {{f % 3 == 0 ? 30.0 : 10.0}, {10.0}};
  const results::Ratio cost = relative_cost({run});
  EXPECT_LT(cost.low, cost.value);
  EXPECT_GT(cost.high, cost.value);
}

TEST(PairedCost, OfOnePairMightBeAnything) {
  const PairedRun run = {{0, {{30.0}, {10.0}}}}, other = {{0, {{20.0}, {10.0}}}};
  const results::Ratio cost = relative_cost({run});
  EXPECT_NEAR(cost.value, 3.0, 1e-12);
  EXPECT_EQ(cost.low, 0.0);
  EXPECT_EQ(cost.high, std::numeric_limits<double>::infinity());
  EXPECT_EQ(results::product({2.0, 1.0, 3.0}, cost).low, 0.0);
  EXPECT_EQ(results::product({2.0, 1.0, 3.0}, cost).high, cost.high);
  EXPECT_LE(relative_cost({run, other}).high, 3.0) << "two of them show how far they are apart";
}

TEST(PairedCost, OfMoreRunsIsNarrower) {
  PairedRun run = twice();
  for (auto& [frame, pairs] : run)
    for (std::size_t r = 0; r < 5; ++r) pairs.own[r] *= 1.0 + 0.1 * static_cast<double>(r);
  const results::Ratio once = relative_cost({run}), often = relative_cost({run, run, run, run});
  EXPECT_NEAR(often.value, once.value, 1e-12);
  EXPECT_LT(often.high - often.low, 0.8 * (once.high - once.low));
}

TEST(PairedCost, OfRunsThatTimedDifferentFramesIsThatOfTheSharedOnes) {
  PairedRun less = twice();
  less.erase(2);
  PairedRun more = twice();
  for (double& own : more[2].own) own *= 100.0;
  EXPECT_NEAR(relative_cost({more, less}).value, 2.0, 1e-12);
}

timing::QuestionSamples played(const std::vector<std::vector<double>>& nanoseconds) {
  timing::QuestionSamples samples;
  for (const std::vector<double>& pass : nanoseconds) {
    samples.playback.emplace_back();
    for (const double ns : pass) samples.playback.back().push_back({0.0, 0.0, ns});
  }
  return samples;
}

TEST(PairUp, TakesThePassesThatBothHaveWithoutTheirFirstFrames) {
  const PairedRun run =
      pair_up(played({{100.0, 6.0, 8.0}, {100.0, 7.0, 9.0}}), played({{50.0, 0.0, 4.0}}));
  ASSERT_EQ(run.size(), 2u);
  EXPECT_EQ(run.at(1).own, std::vector<double>{6.0});
  EXPECT_EQ(run.at(1).anchor, std::vector<double>{1.0}) << "the clock did not tick";
  EXPECT_EQ(run.at(2).own, std::vector<double>{8.0});
  EXPECT_EQ(run.at(2).anchor, std::vector<double>{4.0});
}

TEST(PairUp, PairsPassByPass) {
  const PairedRun run = pair_up(played({{1.0, 6.0}, {1.0, 8.0}}), played({{1.0, 3.0}, {1.0, 4.0}}));
  EXPECT_EQ(run.at(1).own, (std::vector<double>{6.0, 8.0}));
  EXPECT_EQ(run.at(1).anchor, (std::vector<double>{3.0, 4.0}));
  EXPECT_NEAR(relative_cost({run}).value, 2.0, 1e-12);
}

TEST(PairUp, OfASceneOfOneFrameIsThatFrame) {
  const PairedRun run = pair_up(played({{6.0}}), played({{3.0}}));
  ASSERT_EQ(run.size(), 1u);
  EXPECT_EQ(run.at(0).own, std::vector<double>{6.0});
}

}  // namespace
}  // namespace contactcheck::tune
