#include "reference/report/scene_tables.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/report/claims.h"
#include "reference/report/run_row.h"
#include "reference/results/results_json.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::Not;

Json near_run() {
  return Json::parse(R"json({
    "scene": "hello", "detector": "bullet-vf", "status": "ok", "options": {"margin": "0.001", "scale": "0"},
    "semantics": {"levels": ["body", "near"], "informative": ["vertex"], "questions": ["contacts", "body"],
                  "body": "surface", "touching": "open", "exact": false, "margin": 0.002,
                  "precision": "single", "scale": 64.0, "depth_kind": "vertex-surface", "means": "near | far"},
    "levels": {
      "body": {"truth": 10, "reported": 10, "hit": 10, "missed": 0, "spurious": 0, "recall": 1.0, "spurious_rate": 0.0},
      "vertex": {"truth": 40, "reported": 9, "hit": 4, "missed": 36, "spurious": 5, "recall": 0.1, "spurious_rate": 0.5555, "informative": true},
      "near": {"truth": 50, "reported": 49, "hit": 49, "missed": 1, "spurious": 0, "recall": 0.98, "spurious_rate": 0.0, "margin": 0.002}},
    "levels_rounded": {
      "near": {"truth": 49, "reported": 49, "hit": 49, "missed": 0, "spurious": 0, "recall": 1.0, "spurious_rate": 0.0, "margin": 0.002}},
    "geometry": {"missed_length": null, "covered_length_fraction": null, "spurious_distance_max": null,
                 "depth_kind": "vertex-surface", "depth_judged": 4, "depth_error_max": 0.004, "depth_error_mean": 0.001,
                 "depth_error_p95": 0.003, "normal_judged": 3, "normal_error_deg_max": 180.0, "normal_error_deg_mean": 90.0,
                 "normal_error_deg_p95": 179.5},
    "stages": [{"name": "tree", "unit": "triangle pairs", "in": 900, "out": 30, "missed": 1, "visited": 77, "visited_unit": "node pairs"}],
    "time_ms": {"prepare": 1.0},
    "speedup": {"body": {"fcl-aabb": {"cold": {"ratio": 2.0, "low": 1.5, "high": 2.5}, "hot": {"ratio": 3.0, "low": 2.5, "high": 3.5},
                "contact_frames": null, "without_map": null, "reference_options": {"depth": "deep"}}}}
  })json");
}

Json scene_json_of(std::vector<Json> runs) {
  return {{"scenes", {{{"id", "hello"}, {"contact_frames", 10}}}}, {"runs", std::move(runs)}};
}

results::Results results_of(std::vector<Json> runs) {
  return results::from_json(scene_json_of(std::move(runs)));
}

// "" where the scene has no such table.
std::string detail_of(const std::string& title, std::vector<Json> runs) {
  const results::Results results = results_of(std::move(runs));
  const results::Index index(results);
  for (const TitledTable& table : scene_report(index, results.scenes[0]).details)
    if (table.title.starts_with(title)) return markdown_of(table);
  return "";
}

Json renamed(Json run, const char* detector) {
  run["detector"] = detector;
  return run;
}

TEST(LevelsTable, TellsDoublesFromValuesFedAndClaimsFromWhatIsInformative) {
  const std::string table = detail_of("Every level", {near_run()});
  EXPECT_THAT(
      table,
      HasSubstr("| bullet-vf | near (below 2.00 mm) | doubles | 50 | 49 | 1 | 0 | 0.98000 | 0 |"));
  EXPECT_THAT(table, HasSubstr("| bullet-vf | near (below 2.00 mm) | values fed | 49 | 49 | 0 | 0 "
                               "| 1 | 0 |"));
  EXPECT_THAT(table, HasSubstr("| bullet-vf | vertex, informative | doubles | 40 | 9 | 36 | 5 |"));
}

TEST(TimesTable, HasTheDetectorsOwnClockWhereItHasOne) {
  Json with_clock = near_run(), without = renamed(near_run(), "other");
  const Json phases = {
      {"map", 0.5}, {"update", 1.0}, {"query", 2.0}, {"frame", 3.5}, {"contact_frame", 4.0}};
  for (Json* run : {&with_clock, &without}) {
    (*run)["time_ms"] = {{"prepare", 1.0}, {"question", "body"}, {"timed_frames", 7},
                         {"repeats", 5},   {"cold", phases},     {"hot", phases}};
    (*run)["memory_bytes"] = 1048576;
  }
  with_clock["time_ms"]["cold"]["self_reported"] = 2.25;
  const std::string table = detail_of("Times", {with_clock, without});
  EXPECT_THAT(table, HasSubstr("| contact frame | own clock | frame, hot |"));
  EXPECT_THAT(table,
              HasSubstr("| bullet-vf | body | 1.00 | 0.500 | 1.00 | 2.00 | 3.50 | 4.00 | 2.25 |"));
  EXPECT_THAT(table, HasSubstr("| other | body | 1.00 | 0.500 | 1.00 | 2.00 | 3.50 | 4.00 | - |"));
}

TEST(GradedTable, ShowsKindAndSpreadOfDepthsAndNormals) {
  EXPECT_THAT(
      detail_of("Graded errors", {near_run()}),
      HasSubstr("| bullet-vf | - | - | - | vertex-surface | 4 | 4.00 / 1.00 / 3.00 | 3 | 180 "
                "/ 90.0 / 180 |"));
}

TEST(GradedTable, IsEmptyForDetectorsWithoutContourAndDepth) {
  Json run = near_run();
  run["geometry"] = {{"depth_kind", "none"}};
  EXPECT_EQ(detail_of("Graded errors", {run}), "");
}

TEST(StagesTable, ShowsWhatAStageVisited) {
  EXPECT_THAT(detail_of("Which stage", {near_run()}),
              HasSubstr("| bullet-vf | tree | triangle pairs | 900 | 30 | 77 node pairs | 1 |"));
}

TEST(CountersTable, GivesMeansPerFrameOfDetectorsThatCount) {
  Json run = near_run();
  EXPECT_EQ(detail_of("Work per frame", {run}), "");
  run["frames"] = 50;
  run["counters"] = {{"leaves_mapped", 600}, {"exact_tests", 0}};
  EXPECT_THAT(detail_of("Work per frame", {run}),
              HasSubstr("| bullet-vf | 12.0 leaves mapped, 0 exact tests |"));
}

TEST(SpeedupsTable, HasTheOptionsOfBothSides) {
  EXPECT_THAT(
      detail_of("Speed-ups", {near_run()}),
      HasSubstr("| bullet-vf | margin=0.001, scale=0 | body | fcl-aabb | depth=deep | 2.00x "
                "[1.50, 2.50] | 3.00x [2.50, 3.50] | - | - |"));
}

TEST(SpeedupsTable, LeavesOutTheReferenceAgainstItself) {
  EXPECT_EQ(detail_of("Speed-ups", {renamed(near_run(), "fcl-aabb")}), "");
}

TEST(SceneReport, HasNoDetailsOfRunsThatAreNotOk) {
  const Json broken = {{"scene", "hello"}, {"detector", "x"}, {"status", "error"}};
  const results::Results results = results_of({broken});
  const results::Index index(results);
  const SceneReport report = scene_report(index, results.scenes[0]);
  EXPECT_TRUE(report.details.empty());
  ASSERT_EQ(report.result.rows.size(), 1u);
  EXPECT_EQ(report.result.rows[0][1], "error");
}

TEST(SceneReport, TellsTheTruthOfEachLevelAndWhatElseAReaderMustKnow) {
  results::Results results = results_of({near_run()});
  results.scenes[0].truth = {{Level::kBody, std::uint64_t{13}},
                             {Level::kVertex, "not judged: open"}};
  results.runs[0].float_environment = {"flush-to-zero was on"};
  results.runs[0].not_judged = {{Level::kTriangle, "is not claimed"}};
  results.disagreements = {{"hello", "bullet-vf", "near", "missed", "cases/1.json", 17},
                           {"other", "bullet-vf", "near", "missed", "cases/2.json", 1}};
  const results::Index index(results);
  const SceneReport report = scene_report(index, results.scenes[0]);
  EXPECT_EQ(report.truth, "True contacts, summed over frames: body 13, vertex not judged: open.");
  EXPECT_EQ(report.notes, (std::vector<std::string>{"bullet-vf: flush-to-zero was on",
                                                    "bullet-vf: level triangle is not claimed"}));
  ASSERT_EQ(report.disagreements.size(), 1u);
  EXPECT_EQ(report.disagreements[0]->frame, 17u);
}

TEST(SemanticsText, NamesEveryClaim) {
  EXPECT_EQ(
      semantics_text(results_of({near_run()}).runs[0].semantics),
      "levels body, near; informative vertex; questions contacts, body; surface, open, not "
      "exact; margin 2.00 mm; single precision, scale 64.0; depth vertex-surface; near | far");
}

Json fcl_run(double farthest) {
  Json run = renamed(near_run(), "fcl-aabb");
  run["levels"] = {{"triangle", {{"reported", 1843}, {"spurious", 51}}}};
  run["geometry"]["spurious_distance_max"] = farthest;
  return run;
}

TEST(FclFindings, NameScenesWhereOnlyRoundingParts) {
  const std::string text = claims_markdown(results_of({fcl_run(4e-18)}));
  EXPECT_THAT(text, HasSubstr("gaps below rounding"));
  EXPECT_THAT(text, HasSubstr("| hello | fcl-aabb | 1843 | 51 | 4.00e-15 |"));
}

TEST(FclFindings, AreSilentWhereAnotherCauseMayBe) {
  EXPECT_EQ(claims_markdown(results_of({fcl_run(1e-6)})), "");
  Json right = fcl_run(4e-18);
  right["levels"]["triangle"]["spurious"] = 0;
  EXPECT_EQ(claims_markdown(results_of({right, renamed(fcl_run(4e-18), "embree")})), "");
  Json family = scene_json_of({fcl_run(4e-18)});
  family["scenes"][0]["family"] = Json::object();
  EXPECT_EQ(claims_markdown(results::from_json(family)), "");
  EXPECT_EQ(
      claims_markdown(results_of({{{"scene", "hello"}, {"detector", "x"}, {"status", "error"}}})),
      "");
}

TEST(BulletFindings, SetTheScalesSideBySide) {
  Json plain = renamed(near_run(), "bullet-vf:scale=1");
  plain["levels"]["body"]["recall"] = 0.0;
  plain["levels"]["near"]["recall"] = 0.01;
  const std::string text = claims_markdown(results_of({near_run(), plain}));
  EXPECT_THAT(text, HasSubstr("small triangles do not exist"));
  EXPECT_THAT(text, HasSubstr("| hello | 64.0 | 1 | 0.98000 | 0 | 0.01000 |"));
}

TEST(BulletFindings, CountTheVerticesInsideThatAreReported) {
  EXPECT_THAT(claims_markdown(results_of({near_run()})),
              HasSubstr("| hello | 2.00 | 40 | 4 | 5 |"));
}

TEST(BulletFindings, SayWhyNormalsAreTurned) {
  Json run = near_run();
  EXPECT_THAT(claims_markdown(results_of({run})), HasSubstr("| hello | 3 | - | 90.0 | 180 |"));
  run["geometry"]["normal_error_deg_histogram"] = {
      {{"from", 0.0}, {"below", 5.0}, {"count", 1}},
      {{"from", 175.0}, {"below", 180.0}, {"count", 2}}};
  EXPECT_THAT(claims_markdown(results_of({run})), HasSubstr("| hello | 3 | 2 | 90.0 | 180 |"));
  run["geometry"]["normal_error_deg_max"] = 12.0;
  EXPECT_THAT(claims_markdown(results_of({run})), Not(HasSubstr("normals turn")));
}

TEST(BulletFindings, NameTheFalseContactsOfClusters) {
  EXPECT_THAT(claims_markdown(results_of({renamed(near_run(), "bullet-cl:k=256")})),
              HasSubstr("| hello | bullet-cl:k=256 | 10 | 0 | 0 |"));
}

TEST(BulletFindings, AreSilentWithoutBullet) {
  EXPECT_EQ(claims_markdown(results_of({renamed(near_run(), "fcl-aabb")})), "");
}

}  // namespace
}  // namespace contactcheck
