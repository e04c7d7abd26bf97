#include <gmock/gmock.h>

#include "reference/results/results.h"

namespace contactcheck::results {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Optional;

LevelCounts rated(LevelCounts counts) {
  counts.set_rates();
  return counts;
}

TEST(LevelCounts, RatesOverNothingHaveNoValue) {
  const LevelCounts nothing = rated({});
  EXPECT_EQ(nothing.recall, std::nullopt);
  EXPECT_EQ(nothing.spurious_rate, std::nullopt);
}

TEST(LevelCounts, SpuriousOverReportedExistsWithoutTruth) {
  const LevelCounts only_reported = rated({0, 4, 0, 0, 4});
  EXPECT_EQ(only_reported.recall, std::nullopt);
  EXPECT_THAT(only_reported.spurious_rate, Optional(1.0));
}

TEST(LevelCounts, RecallIsHitOverTruthAndSpuriousIsOverReported) {
  const LevelCounts counts = rated({8, 10, 6, 2, 4});
  EXPECT_THAT(counts.recall, Optional(0.75));
  EXPECT_THAT(counts.spurious_rate, Optional(0.4));
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

TEST(Status, NamesAreTheWordsOfTheDesign) {
  EXPECT_STREQ(name_of(Status::kOk), "ok");
  EXPECT_STREQ(name_of(Status::kError), "error");
  EXPECT_STREQ(name_of(Status::kAbsent), "absent");
  EXPECT_STREQ(name_of(Status::kRefused), "refused");
}

TEST(Hex, HasSixteenDigits) {
  EXPECT_EQ(hex(0), "0x0000000000000000");
  EXPECT_EQ(hex(0xfedcba9876543210), "0xfedcba9876543210");
}

Scene scene(const std::string& id) {
  Scene out;
  out.id = id;
  return out;
}

Run row(const std::string& scene, const std::string& detector, Status status = Status::kOk) {
  Run out;
  out.scene = scene;
  out.detector = detector;
  out.status = status;
  return out;
}

/// Rows of the two scenes stand between one another, and one row's scene is not described.
struct Indexed : testing::Test {
  Indexed() {
    results.scenes = {scene("first"), scene("second")};
    results.runs = {row("second", "b"), row("first", "c", Status::kError), row("second", "a"),
                    row("first", "a"), row("elsewhere", "b", Status::kAbsent)};
  }

  Results results;
};

TEST_F(Indexed, SceneIsFoundByItsId) {
  const Index index(results);
  EXPECT_EQ(&index.results(), &results);
  EXPECT_EQ(index.scene("second"), &results.scenes[1]);
  EXPECT_EQ(index.scene("elsewhere"), nullptr) << "a row names it, but it is not described";
  EXPECT_EQ(index.scene(""), nullptr);
}

TEST_F(Indexed, RowIsFoundByItsSceneAndDetector) {
  const Index index(results);
  EXPECT_EQ(index.run("first", "a"), &results.runs[3]);
  EXPECT_EQ(index.run("second", "a"), &results.runs[2]);
  EXPECT_EQ(index.run("elsewhere", "b"), &results.runs[4]);
  EXPECT_EQ(index.run("first", "b"), nullptr) << "both are known, but not together";
  EXPECT_EQ(index.run("first", "nobody"), nullptr);
  EXPECT_EQ(index.run("nowhere", "a"), nullptr);
}

TEST_F(Indexed, RowThatIsNotOkIsNoOkRun) {
  const Index index(results);
  EXPECT_EQ(index.run("first", "c"), &results.runs[1]);
  EXPECT_EQ(index.ok_run("first", "c"), nullptr);
  EXPECT_EQ(index.ok_run("elsewhere", "b"), nullptr);
  EXPECT_EQ(index.ok_run("first", "a"), &results.runs[3]);
  EXPECT_EQ(index.ok_run("first", "nobody"), nullptr);
}

TEST_F(Indexed, RowsOfASceneAreInTheOrderOfTheFile) {
  const Index index(results);
  EXPECT_THAT(index.runs_of("first"), ElementsAre(&results.runs[1], &results.runs[3]));
  EXPECT_THAT(index.runs_of("second"), ElementsAre(&results.runs[0], &results.runs[2]));
  EXPECT_THAT(index.runs_of("nowhere"), IsEmpty());
}

TEST_F(Indexed, DetectorsAreThereOnceByTheirFirstRows) {
  EXPECT_THAT(Index(results).detectors(), ElementsAre("b", "c", "a"));
}

// The first counts: a file may name a scene or a row twice.
TEST_F(Indexed, OfRowsOfOneNameTheFirstIsFound) {
  results.scenes.push_back(scene("first"));
  results.runs.push_back(row("first", "a", Status::kError));
  const Index index(results);
  EXPECT_EQ(index.scene("first"), &results.scenes[0]);
  EXPECT_EQ(index.ok_run("first", "a"), &results.runs[3]);
  EXPECT_EQ(index.runs_of("first").size(), 3u);
}

}  // namespace
}  // namespace contactcheck::results
