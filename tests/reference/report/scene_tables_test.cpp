#include "reference/report/scene_tables.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "reference/report/claims.h"
#include "reference/report/run_row.h"
#include "reference/results/results_json.h"

namespace contactcheck::report {
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
    "speedup": {"body": {"fcl-aabb": {"playback": {"ratio": 2.0, "low": 1.5, "high": 2.5}, "cold": null,
                "contact_frames": null, "without_map": null, "passes": 3, "reference_options": {"depth": "deep"}}}}
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
  const Json phases = {{"map", 0.5},           {"update", 1.0},      {"query", 2.0}, {"frame", 3.5},
                       {"contact_frame", 4.0}, {"first_frame", 5.0}, {"cpu", 6.0}};
  for (Json* run : {&with_clock, &without}) {
    (*run)["time_ms"] = {{"prepare", 1.0}, {"question", "body"}, {"timed_frames", 7},
                         {"passes", 5},    {"playback", phases}, {"cold", phases}};
    (*run)["memory_bytes"] = 1048576;
  }
  with_clock["time_ms"]["playback"]["self_reported"] = 2.25;
  const std::string table = detail_of("Times", {with_clock, without});
  EXPECT_THAT(table, HasSubstr("| contact frame | first frame | own clock | CPU time |"));
  EXPECT_THAT(
      table,
      HasSubstr(
          "| bullet-vf | body | 1.00 | 0.500 | 1.00 | 2.00 | 3.50 | 4.00 | 5.00 | 2.25 | 6.00 |"));
  EXPECT_THAT(table,
              HasSubstr("| other | body | 1.00 | 0.500 | 1.00 | 2.00 | 3.50 | 4.00 | 5.00 | - |"));
}

TEST(TimesTable, SaysWhereFramesWereNotTimed) {
  Json run = near_run();
  run["frames"] = 60;
  run["time_ms"] = {{"question", "body"}, {"timed_frames", 4}, {"passes", 3}};
  EXPECT_THAT(detail_of("Times", {run}), HasSubstr("| 4 of 60 frames | 3 |"));
  EXPECT_THAT(detail_of("Speed-ups", {run}), HasSubstr("| 3 (4 of 60 frames) |"));
  EXPECT_THAT(result_cells(results_of({run}).runs[0])[10], "0 (4 of 60 frames)");
}

// A number as it is printed lies within half a unit of its last digit.
struct Printed {
  double value = 0.0, half_unit = 0.0;

  explicit Printed(const std::string& text) : value(std::stod(text)) {
    const std::string digits = text.substr(0, text.find_first_not_of("0123456789."));
    const std::size_t point = digits.find('.');
    const auto decimals =
        point == std::string::npos ? 0.0 : static_cast<double>(digits.size() - point - 1);
    half_unit = 0.5 * std::pow(10.0, -decimals);
  }
  double low() const { return value - half_unit; }
  double high() const { return value + half_unit; }
};

void expect_quotient(const std::string& reference, const std::string& detector,
                     const std::string& ratio) {
  const Printed over(reference), under(detector), printed(ratio);
  EXPECT_LE(over.low() / under.high(), printed.high()) << reference << " / " << detector;
  EXPECT_GE(over.high() / under.low(), printed.low()) << reference << " / " << detector;
}

Json times_of(const char* question, double frame) {
  return {{"question", question},
          {"timed_frames", 60},
          {"passes", 5},
          {"playback", {{"query", frame}, {"frame", frame}, {"first_frame", 2.0 * frame}}}};
}

Json timed_run(const char* detector, std::vector<std::pair<const char*, double>> times) {
  Json run = {{"scene", "hello"}, {"detector", detector}, {"status", "ok"}, {"frames", 60}};
  for (const auto& [question, frame] : times) {
    run["semantics"]["questions"].push_back(question);
    if (!run.contains("time_ms")) {
      run["time_ms"] = times_of(question, frame);
    } else {
      run["time_ms_other_questions"].push_back(times_of(question, frame));
    }
  }
  return run;
}

Json speedup_of_times(double reference, double detector) {
  const double ratio = reference / detector;
  return {{"playback", {{"ratio", ratio}, {"low", 0.9 * ratio}, {"high", 1.1 * ratio}}},
          {"passes", 5}};
}

// The cell detector's own question is another one than that of its speed-ups.
std::vector<Json> timed_runs() {
  Json reference = timed_run("fcl-aabb", {{"triangles", 7.654}, {"body", 1.2345}}),
       exact = timed_run("exact", {{"triangles", 0.6789}, {"body", 0.5}}),
       cells = timed_run("cells", {{"cells", 0.0777}, {"body", 0.3217}});
  exact["speedup"]["triangles"]["fcl-aabb"] = speedup_of_times(7.654, 0.6789);
  exact["speedup"]["body"]["fcl-aabb"] = speedup_of_times(1.2345, 0.5);
  cells["speedup"]["body"]["fcl-aabb"] = speedup_of_times(1.2345, 0.3217);
  return {reference, exact, cells};
}

class PrintedTable {
 public:
  explicit PrintedTable(const TitledTable& table) : table_(table) {}
  std::size_t rows() const { return table_.rows.size(); }
  std::string cell(std::size_t row, const std::string& title) const {
    for (std::size_t c = 0; c < table_.columns.size(); ++c)
      if (table_.columns[c].title == title) return table_.rows.at(row).at(c);
    ADD_FAILURE() << "no column " << title;
    return "";
  }
  /// Of the row of a detector and question.
  std::string cell(const std::string& detector, const std::string& question,
                   const std::string& title) const {
    for (std::size_t row = 0; row < rows(); ++row)
      if (cell(row, "detector") == detector && cell(row, "question") == question)
        return cell(row, title);
    ADD_FAILURE() << "no row of " << detector << ", " << question;
    return "";
  }

 private:
  TitledTable table_;
};

PrintedTable printed_detail(const SceneReport& report, const std::string& title) {
  for (const TitledTable& table : report.details)
    if (table.title.starts_with(title)) return PrintedTable(table);
  return PrintedTable(TitledTable{});
}

TEST(PrintedTimes, QuotientsAreThePrintedSpeedups) {
  const results::Results results = results_of(timed_runs());
  const results::Index index(results);
  const SceneReport report = scene_report(index, results.scenes[0]);
  const PrintedTable result(report.result), times = printed_detail(report, "Times"),
                                            speedups = printed_detail(report, "Speed-ups");
  ASSERT_EQ(speedups.rows(), 3u);
  for (std::size_t row = 0; row < speedups.rows(); ++row) {
    const std::string question = speedups.cell(row, "question");
    expect_quotient(times.cell(speedups.cell(row, "reference"), question, "frame"),
                    times.cell(speedups.cell(row, "detector"), question, "frame"),
                    speedups.cell(row, "playback"));
  }
  ASSERT_EQ(result.rows(), 3u);
  expect_quotient(result.cell("fcl-aabb", "triangles", "ms/frame"),
                  result.cell("exact", "triangles", "ms/frame"),
                  result.cell("exact", "triangles", "vs fcl-aabb"));
  expect_quotient(times.cell("fcl-aabb", "body", "frame"), result.cell("cells", "body", "ms/frame"),
                  result.cell("cells", "body", "vs fcl-aabb"));
}

TEST(ResultTable, ShowsItsOwnQuestionWhereItWasNotTimedInTheOneCompared) {
  Json run = timed_runs()[2];
  run.erase("time_ms_other_questions");
  const results::Results results = results_of({run});
  const results::Index index(results);
  const PrintedTable result(scene_report(index, results.scenes[0]).result);
  EXPECT_EQ(result.cell("cells", "cells", "ms/frame"), "0.0777");
  EXPECT_EQ(result.cell("cells", "cells", "vs fcl-aabb"), "-");
}

TEST(ResultTable, SaysWhereAReferenceHasFewerPasses) {
  std::vector<Json> runs = timed_runs();
  runs[1]["speedup"]["triangles"]["fcl-aabb"]["passes"] = 1;
  const results::Results results = results_of(runs);
  const results::Index index(results);
  const PrintedTable result(scene_report(index, results.scenes[0]).result);
  EXPECT_EQ(result.cell("exact", "triangles", "passes"), "5");
  EXPECT_EQ(result.cell("exact", "triangles", "vs fcl-aabb"), "11.3x (1 pass)");
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
                "(1.50 to 2.50) | - | - | - | 3 |"));
}

TEST(SpeedupsTable, CallsTheEndsOfFewPassesARange) {
  const auto table_over = [](std::size_t passes) {
    Json run = near_run();
    run["speedup"]["body"]["fcl-aabb"]["passes"] = passes;
    return detail_of("Speed-ups", {run});
  };
  EXPECT_THAT(table_over(3), HasSubstr("(low to high) is the range of 3 passes."));
  EXPECT_THAT(table_over(3), Not(HasSubstr("95 %")));
  EXPECT_THAT(table_over(5), HasSubstr("[low, high] is the 95 % interval over 5 passes."));
  EXPECT_THAT(table_over(5), HasSubstr("| 2.00x [1.50, 2.50] | - | - | - | 5 |"));
  EXPECT_THAT(table_over(1), HasSubstr("| 2.00x (1 pass) | - | - | - | 1 |"));
  EXPECT_THAT(table_over(1), Not(HasSubstr("range")));
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
}  // namespace contactcheck::report
