#include <gmock/gmock.h>

#include "reference/compare/run_result.h"

namespace contactcheck {
namespace {

using testing::Eq;
using testing::Optional;

TEST(LevelCounts, RatesOverNothingHaveNoValue) {
  const LevelCounts nothing;
  EXPECT_EQ(nothing.recall(), std::nullopt);
  EXPECT_EQ(nothing.spurious_rate(), std::nullopt);
}

TEST(LevelCounts, SpuriousOverReportedExistsWithoutTruth) {
  const LevelCounts only_reported{0, 4, 0, 0, 4};
  EXPECT_EQ(only_reported.recall(), std::nullopt);
  EXPECT_THAT(only_reported.spurious_rate(), Optional(1.0));
}

TEST(LevelCounts, RecallIsHitOverTruthAndSpuriousIsOverReported) {
  const LevelCounts counts{8, 10, 6, 2, 4};
  EXPECT_THAT(counts.recall(), Optional(0.75));
  EXPECT_THAT(counts.spurious_rate(), Optional(0.4));
}

TEST(LevelCounts, AddUpFieldByField) {
  LevelCounts sum{1, 2, 3, 4, 5};
  sum += LevelCounts{10, 20, 30, 40, 50};
  EXPECT_EQ(sum.truth, 11u);
  EXPECT_EQ(sum.reported, 22u);
  EXPECT_EQ(sum.hit, 33u);
  EXPECT_EQ(sum.missed, 44u);
  EXPECT_EQ(sum.spurious, 55u);
}

TEST(LevelCounts, PerfectNeedsNeitherMissedNorSpurious) {
  EXPECT_TRUE((LevelCounts{3, 3, 3, 0, 0}.perfect()));
  EXPECT_FALSE((LevelCounts{3, 2, 2, 1, 0}.perfect()));
  EXPECT_FALSE((LevelCounts{3, 4, 3, 0, 1}.perfect()));
}

Episode episode(std::optional<double> gap, std::optional<long> late) {
  Episode e;
  e.hover_gap = gap;
  e.late_frames = late;
  return e;
}

TEST(RunResult, WorstHoverGapAndLatenessAreNullWithoutEpisodes) {
  const RunResult run;
  EXPECT_EQ(run.hover_gap_max(), std::nullopt);
  EXPECT_EQ(run.late_frames_worst(), std::nullopt);
}

TEST(RunResult, WorstLatenessKeepsItsSign) {
  RunResult run;
  run.episodes = {episode(0.5, 2), episode(std::nullopt, std::nullopt), episode(0.25, -3)};
  EXPECT_THAT(run.hover_gap_max(), Optional(0.5));
  EXPECT_THAT(run.late_frames_worst(), Optional(Eq(-3)));
}

}  // namespace
}  // namespace contactcheck
