// Random pairs from the generator to the verdict on the oracle and on detectors.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/judge/accuracy.h"
#include "reference/judge/scene_summary.h"
#include "reference/oracle/rational_clipping.h"
#include "tests/faults/broken_detectors.h"

namespace contactcheck::judge {
namespace {

constexpr std::size_t kFrames = 10;

class RandomPairsJudged : public testing::Test {
 protected:
  RandomPairsJudged()
      : scene_(scene::make_pairs_scene({kFrames * scene::RandomPairs::kSlots, 3})),
        progress_(&page_),
        judged_(judge_scene(scene_, progress_)) {}

  /// The verdict on a truth that may have been spoiled.
  PairTally tally_with(const std::vector<oracle::Truth>& truth, unsigned threads = 0) const {
    PairTally tally;
    for (std::size_t f = 0; f < scene_.frames; ++f)
      check_pairs(*scene_.pairs(), f, judged_.positions[f].vertices, truth[f], tally, threads);
    return tally;
  }

  scene::Scene scene_;
  process::SharedProgress page_;
  process::ProgressWriter progress_;
  JudgedScene judged_;
};

TEST_F(RandomPairsJudged, OracleAndRationalArithmeticAgree) {
  ASSERT_TRUE(judged_.pairs);
  EXPECT_EQ(judged_.pairs->checked(), kFrames * scene::RandomPairs::kSlots);
  EXPECT_EQ(judged_.pairs->oracle_wrong, 0u);
  EXPECT_TRUE(judged_.pairs->disagreements.empty());
}

// A kind whose answer is known beforehand would try nothing.
TEST_F(RandomPairsJudged, QuarterToThreeQuartersOfEveryKindTouch) {
  for (std::size_t k = 0; k < scene::kPairKinds; ++k) {
    const PairTally::Kind& kind = judged_.pairs->kinds[k];
    EXPECT_GT(4 * kind.touching, kind.pairs) << scene::name_of(static_cast<scene::PairKind>(k));
    EXPECT_LT(4 * kind.touching, 3 * kind.pairs) << scene::name_of(static_cast<scene::PairKind>(k));
  }
}

TEST_F(RandomPairsJudged, QuickRationalTestAgreesWithTheLinearProgram) {
  for (std::size_t f = 0; f < kFrames; ++f)
    for (std::size_t slot = 0; slot < scene::RandomPairs::kSlots; ++slot) {
      const scene::HardPair p = scene_.pairs()->pair(f, slot);
      ASSERT_EQ(oracle::rational::triangles_intersect_by_clipping(p.a, p.b),
                oracle::rational::triangles_intersect(p.a, p.b))
          << "frame " << f << ", slot " << slot;
    }
}

TEST_F(RandomPairsJudged, TallyDoesNotDependOnTheNumberOfThreads) {
  const PairTally one = tally_with(judged_.truth, 1), three = tally_with(judged_.truth, 3);
  for (std::size_t k = 0; k < scene::kPairKinds; ++k) {
    EXPECT_EQ(one.kinds[k].pairs, three.kinds[k].pairs);
    EXPECT_EQ(one.kinds[k].touching, three.kinds[k].touching);
  }
  EXPECT_EQ(three.oracle_wrong, 0u);
}

TEST_F(RandomPairsJudged, OracleThatMissesIsFoundOut) {
  std::vector<oracle::Truth> truth = judged_.truth;
  std::vector<ElementPair>& pairs = truth[6].surface.triangles;
  const ElementPair missed = pairs[17];
  pairs.erase(pairs.begin() + 17);
  truth[8].surface.triangles.pop_back();
  const PairTally tally = tally_with(truth);
  EXPECT_EQ(tally.oracle_wrong, 2u);
  ASSERT_EQ(tally.disagreements.size(), 1u) << "the first of its kind";
  EXPECT_EQ(tally.disagreements[0].kind, "missed");
  EXPECT_EQ(tally.disagreements[0].level, "triangle");
  EXPECT_EQ(tally.disagreements[0].frame, 6u);
  EXPECT_EQ(tally.disagreements[0].pair, missed);
}

TEST_F(RandomPairsJudged, OracleWithSpuriousPairsIsFoundOut) {
  std::vector<oracle::Truth> truth = judged_.truth;
  std::vector<ElementPair>& pairs = truth[2].surface.triangles;
  std::uint32_t disjoint = 0;
  while (std::binary_search(pairs.begin(), pairs.end(), ElementPair{0, 1, disjoint, disjoint}))
    ++disjoint;
  pairs.push_back({0, 1, disjoint, disjoint});
  pairs.push_back({0, 1, 4, 5});
  canonicalize(pairs);
  const PairTally tally = tally_with(truth);
  EXPECT_EQ(tally.oracle_wrong, 2u);
  ASSERT_EQ(tally.disagreements.size(), 1u);
  EXPECT_EQ(tally.disagreements[0].kind, "spurious");
  EXPECT_EQ(tally.disagreements[0].frame, 2u);
}

TEST_F(RandomPairsJudged, SummaryHasCountSeedKindsAndVerdict) {
  judged_.pairs->oracle_wrong = 2;
  const results::Scene scene = scene_summary(judged_);
  const results::RandomPairs pairs = scene.pairs.value();
  EXPECT_EQ(pairs.count, kFrames * scene::RandomPairs::kSlots);
  EXPECT_EQ(pairs.seed, 3u);
  EXPECT_EQ(pairs.touching, std::get<std::uint64_t>(scene.truth.at(Level::kTriangle)));
  ASSERT_EQ(pairs.per_kind.size(), scene::kPairKinds);
  EXPECT_EQ(pairs.per_kind.back().first, "mixed-scale");
  EXPECT_EQ(pairs.per_kind.back().second.touching, judged_.pairs->kinds.back().touching);
  EXPECT_EQ(pairs.checked, kFrames * scene::RandomPairs::kSlots);
  EXPECT_EQ(pairs.oracle_wrong, 2u);
}

TEST_F(RandomPairsJudged, DetectorThatDropsPairsIsCounted) {
  std::uint64_t dropped = 0;
  for (const oracle::Truth& t : judged_.truth) dropped += (t.surface.triangles.size() + 9) / 10;
  test::DropsEveryTenth detector;
  results::Run result;
  JudgingTools tools(judged_);
  const AccuracyOutcome outcome = run_accuracy(tools, 0, detector, progress_, result);
  EXPECT_EQ(result.levels.at(Level::kTriangle).missed, dropped);
  EXPECT_EQ(result.levels.at(Level::kTriangle).spurious, 0u);
  EXPECT_FALSE(result.geometry.missed_length) << "lengths of many scales do not add up";
  ASSERT_FALSE(outcome.disagreements.empty());
  EXPECT_EQ(outcome.disagreements[0].kind, "missed");
}

TEST_F(RandomPairsJudged, FramesComeBackBitForBitAfterOthers) {
  const std::vector<std::vector<Vec3>> vertices = judged_.positions[1].vertices;
  (void)judged_.positions[7];
  EXPECT_EQ(judged_.positions[1].vertices, vertices);
  EXPECT_NE(judged_.positions[7].vertices, vertices);
}

}  // namespace
}  // namespace contactcheck::judge
