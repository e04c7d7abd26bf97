#include "reference/report/summary.h"

#include <gmock/gmock.h>

#include "reference/results/results_json.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck::report {
namespace {

using test::sample_results;
using testing::ElementsAre;

auto summary_of(const nlohmann::ordered_json& results) {
  return summary_table(results::from_json(results)).rows;
}

nlohmann::ordered_json two_scenes_in_order() {
  auto results = sample_results();
  auto more = results;
  more["scenes"][0]["id"] = "again";
  results["scenes"].push_back(more["scenes"][0]);
  for (auto& run : more["runs"]) {
    run["scene"] = "again";
    results["runs"].push_back(run);
  }
  return results;
}

TEST(Summary, HasOneCellPerColumn) {
  const TitledTable summary = summary_table(results::from_json(sample_results()));
  for (const auto& line : summary.rows) EXPECT_EQ(line.size(), summary.columns.size());
}

TEST(Summary, AddsCountsOverScenesAndKeepsTheRangeOfSpeeds) {
  auto results = two_scenes_in_order();
  auto& second = results["runs"][6];
  ASSERT_EQ(second["detector"], "ffd-aabb-sphere2+tri");
  second["speedup"]["triangles"]["fcl-aabb"]["playback"]["ratio"] = 2.5;
  second["speedup"]["triangles"]["fcl-aabb"]["passes"] = 1;
  second["geometry"]["hover_gap_max"] = 0.004;
  const auto lines = summary_of(results);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_THAT(lines[0], ElementsAre("fcl-aabb", "2", "triangle", "400000", "1", "0", "0", "0/0",
                                    "0", "triangles", "5", "1.00x", "-", "-"));
  EXPECT_THAT(lines[1],
              ElementsAre("ffd-aabb-sphere2+tri", "2", "triangle", "400000", "0.99999", "2", "4",
                          "0/4", "4.00", "triangles", "1 to 5", "2.50 to 4.00x", "-", "-"));
}

TEST(Summary, RunsThatAreNotOkAreCountedAndNeverAHitOrAMiss) {
  const auto lines = summary_of(two_scenes_in_order());
  EXPECT_THAT(lines[2], ElementsAre("fcl-obbrss", "0 (2 error)", "", "-", "-", "-", "-", "-", "-",
                                    "", "-", "-", "-", "-"));
}

TEST(Summary, RefusalsAndErrorsAreCountedApart) {
  auto results = two_scenes_in_order();
  for (auto& run : results["runs"])
    if (run["detector"] == "fcl-obbrss" && run["scene"] == "hello") run["status"] = "refused";
  EXPECT_EQ(summary_of(results)[2][1], "0 (1 error, 1 refused)");
}

TEST(Summary, RunThatIsNotOkStandsInTheLineOfItsDetector) {
  for (const std::size_t broken : {0, 5}) {
    auto results = two_scenes_in_order();
    results["runs"][broken] = {{"scene", results["runs"][broken]["scene"]},
                               {"detector", "fcl-aabb"},
                               {"status", "error"},
                               {"message", "why"}};
    const auto lines = summary_of(results);
    ASSERT_EQ(lines.size(), 5u);
    EXPECT_EQ(lines[0][1], "1 (1 error)");
    EXPECT_EQ(lines[0][2], "triangle");
    EXPECT_EQ(lines[0][3], "200000");
  }
}

TEST(Summary, LevelsOfDifferentScenesAreNotAddedUp) {
  auto results = two_scenes_in_order();
  auto& second = results["runs"][5];
  ASSERT_EQ(second["detector"], "fcl-aabb");
  second["per_frame"]["level"] = "body";
  second["levels"].erase("triangle");
  const auto lines = summary_of(results);
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_THAT(lines[0], ElementsAre("fcl-aabb", "1", "triangle", "200000", "1", "0", "0", "0/0",
                                    "0", "triangles", "5", "1.00x", "-", "-"));
  EXPECT_THAT(lines[5], ElementsAre("fcl-aabb", "1", "body", "13", "1", "0", "0", "0/0", "0",
                                    "triangles", "5", "1.00x", "-", "-"));
}

}  // namespace
}  // namespace contactcheck::report
