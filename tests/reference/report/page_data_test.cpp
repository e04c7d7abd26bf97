#include "reference/report/formats/page_data.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "reference/report/tables/speed_error.h"
#include "reference/results/results_json.h"
#include "tests/reference/report/hard_results.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck::report {
namespace {

using Json = nlohmann::ordered_json;

Json data_of(const Json& results) { return page_data(results::from_json(results), std::nullopt); }

// The blocks of a section; null where the page has none of that id.
Json blocks_of(const Json& page, const std::string& id) {
  for (const Json& section : page.at("sections"))
    if (section.at("id") == id) return section.at("blocks");
  return nullptr;
}

TEST(PageData, SaysWhatRanWhere) {
  const Json page = data_of(test::sample_results());
  EXPECT_EQ(page.at("run"), "`contactcheck run hello` on A CPU, 2 cores, AVX2.");
  EXPECT_EQ(blocks_of(page, "machine").at(0).at("items").at(3),
            "libraries: eigen 3.4.0, fcl 0.7.0");
  EXPECT_TRUE(page.at("parts").empty());
  EXPECT_EQ(page.at("detectors").size(), 5u);
  EXPECT_EQ(page.at("options").size(), 5u);
  EXPECT_TRUE(page.at("timed").get<bool>());
  Json untimed = test::sample_results();
  for (Json& run : untimed["runs"]) run.erase("time_ms");
  EXPECT_FALSE(data_of(untimed).at("timed").get<bool>());
}

TEST(PageData, ScenesHaveTablesAndCosts) {
  const Json scene = data_of(test::sample_results()).at("scenes").at(0);
  EXPECT_EQ(scene.at("id"), "hello");
  std::vector<std::string> titles;
  for (const Json& table : scene.at("tables")) titles.push_back(table.at("title"));
  EXPECT_THAT(titles,
              testing::ElementsAre("Bodies", "Result", testing::StartsWith("Every level"),
                                   testing::StartsWith("Which stage"), testing::StartsWith("Times"),
                                   testing::StartsWith("Speed-ups")));
  EXPECT_EQ(scene.at("disagreements").at(0).at("case"), "cases/0001.json");
  const Json& costs = scene.at("cost").at("detectors");
  EXPECT_EQ(costs.at(1).at("playback"), 0.5);
  EXPECT_EQ(costs.at(1).at("cold"), 0.75);
  EXPECT_TRUE(costs.at(2).is_null());  // ended in an error
}

TEST(PageData, FamiliesAreNoScenes) {
  const Json page = data_of(test::hard_results());
  EXPECT_TRUE(page.at("scenes").empty());
  ASSERT_EQ(page.at("families").size(), 2u);
  EXPECT_EQ(page.at("families").at(0).at("id"), "one");
  EXPECT_EQ(page.at("families").at(0).at("values").size(), 3u);
}

TEST(PageData, ManyDrawnScenesAreShownAsSumsAlone) {
  const Json many = data_of(test::drawn_sample_results(10));
  EXPECT_TRUE(many.at("scenes").empty());
  EXPECT_EQ(many.at("scene_count"), 10);
  EXPECT_EQ(blocks_of(many, "drawn").at(0).at("text"),
            "10 scenes drawn from seed 7, 5 with contact.");
  EXPECT_EQ(blocks_of(many, "drawn").at(1).at("table").at("title"),
            "Missed and spurious in 5 scenes with contact");
  EXPECT_EQ(many.at("choices"), Json::array({"all 10 scenes", "5 drawn scenes with contact",
                                             "5 drawn scenes without contact"}));
  EXPECT_EQ(many.at("levels").at(0).at("recall").at("columns"),
            Json::array({"detector", "all scenes"}));
  EXPECT_EQ(data_of(test::drawn_sample_results(9)).at("scenes").size(), 9u);
}

TEST(PageData, OtherScenesAreShownWithManyDrawnOnes) {
  Json results = test::drawn_sample_results(10);
  EXPECT_TRUE(data_of(results).at("scenes").empty());
  const Json sample = test::sample_results();
  results["scenes"].push_back(sample["scenes"][0]);
  results["runs"].push_back(sample["runs"][0]);
  EXPECT_EQ(data_of(results).at("scenes").size(), 1u);
}

TEST(PageData, WithoutADrawnSceneHasNoSectionOfThem) {
  EXPECT_FALSE(blocks_of(data_of(test::drawn_sample_results(1)), "drawn").is_null());
  EXPECT_TRUE(blocks_of(data_of(test::sample_results()), "drawn").is_null());
}

TEST(PageData, PaperIsWrittenOutWhereThereIsAReproduction) {
  const PaperPart paper = {
      .overview = {"Ratios", "", {{"scene", true, ""}, {"paper", false, ""}}, {{"s", "2.00x"}}},
      .readings = {"`safe`: contains"},
      .means_title = "Means",
      .means = {"ours 1.5x"},
      .scenes = {{"s", "`paper-s`", {"It does not pay."}, {{"Counts", "", {}, {}}}}},
      .own_numbers = "1 check",
      .checks = {"Checks", "", {{"in words", true, ""}}, {{"Below 0."}}}};
  const results::Results results = results::from_json(test::sample_results());
  EXPECT_EQ(page_data(results, paper).at("paper"), Json::parse(R"({
    "overview": {"title": "Ratios", "text": "",
                 "columns": [{"title": "scene", "left": true}, {"title": "paper", "left": false}],
                 "rows": [["s", "2.00x"]]},
    "readings": ["`safe`: contains"],
    "means_title": "Means",
    "means": ["ours 1.5x"],
    "scenes": [{"title": "s", "aside": "`paper-s`", "sentences": ["It does not pay."],
                "tables": [{"title": "Counts", "text": "", "columns": [], "rows": []}]}],
    "own_numbers": "1 check",
    "checks": {"title": "Checks", "text": "", "columns": [{"title": "in words", "left": true}],
               "rows": [["Below 0."]]}})"));
  EXPECT_FALSE(data_of(test::sample_results()).contains("paper"));
}

// Those with charts are drawn by the page itself, of fields of their own.
TEST(PageData, SectionsAreThoseOfTheOtherReports) {
  const Json page = data_of(test::sample_results());
  std::vector<std::string> ids;
  for (const Json& section : page.at("sections")) ids.push_back(section.at("id"));
  EXPECT_THAT(ids, testing::ElementsAre("summary", "claims", "machine"));
  const Json& summary = page.at("sections").at(0);
  EXPECT_EQ(summary.at("title"), "Summary");
  const Json& table = summary.at("blocks").at(0).at("table");
  EXPECT_EQ(table.at("rows").size(), 5u);
  EXPECT_EQ(table.at("columns").size(), table.at("rows").at(0).size());
  EXPECT_EQ(table.at("columns").at(4).at("id"), "recall");
}

TEST(PageData, GoalsPairsAndKnownDefectsAreTables) {
  results::Results results = results::from_json(test::sample_results());
  Json report = page_data(results, std::nullopt);
  EXPECT_TRUE(blocks_of(report, "goals").is_null());
  EXPECT_TRUE(blocks_of(report, "pairs").is_null());
  EXPECT_TRUE(blocks_of(report, "defects").is_null());
  results.goals.resize(2);
  results.goals[0].at_most = 5.0;
  results.goals[0].met = false;
  results.scenes[0].pairs.emplace().per_kind = {{"sliver", {4, 1}}};
  results.known_defects.emplace().unlisted = {
      {"fcl-aabb", "gap", "missed", {"0", "1e-9"}, {}, {7, 8}}};
  report = page_data(results, std::nullopt);
  const Json goals = blocks_of(report, "goals").at(0).at("table");
  EXPECT_EQ(goals.at("rows").size(), 2u);
  EXPECT_EQ(goals.at("rows").at(0).back(), "no");
  EXPECT_TRUE(goals.at("columns").back().at("verdict"));
  EXPECT_EQ(blocks_of(report, "pairs").at(1).at("table").at("rows").dump(),
            R"([["sliver","4","1","0.250"]])");
  const Json known = blocks_of(report, "defects");
  ASSERT_EQ(known.size(), 2u);
  EXPECT_THAT(known.at(0).at("text").get<std::string>(),
              testing::HasSubstr("2 show that are not listed"));
  EXPECT_EQ(known.at(1).at("table").at("rows").dump(),
            R"([["fcl-aabb","gap","missed","0: 7; 1e-9: 8"]])");
}

TEST(PageData, ClaimsAreThoseOfTheMarkdownReport) {
  const Json claims = blocks_of(data_of(test::sample_results()), "claims");
  ASSERT_EQ(claims.size(), 1u);
  const Json& claim = claims.at(0).at("table");
  EXPECT_EQ(claim.at("title"), "ffd-aabb-sphere2+tri against FCL and Embree, question `triangles`");
  EXPECT_EQ(claim.at("columns").size(), 9u);
  EXPECT_EQ(claim.at("rows").at(0).at(3), "4.00x [3.50, 4.25]");
}

TEST(PageData, LevelsBeginWithTheFinest) {
  const Json levels = data_of(test::sample_results()).at("levels");
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels.at(0).at("level"), "finest");
  EXPECT_EQ(levels.at(2).at("level"), "triangle");
  const Json& cell = levels.at(2).at("recall").at("rows").at(1).at(1);
  EXPECT_EQ(cell.at("text"), "0.99999");
  EXPECT_EQ(cell.at("share"), 1.0 / 200'000);
  EXPECT_EQ(levels.at(0).at("recall").at("rows").at(2).at(1).at("kind"), "error");
}

TEST(PageData, EveryChoiceOfTheChartHasItsPoints) {
  const Json report = data_of(test::sample_results());
  EXPECT_EQ(report.at("choices"), Json({"scene hello"}));
  const Json& charts = report.at("speed_error");
  const Json& finest = charts.at("charts").at(0).at("finest");
  for (const char* choice : {"worse playback", "worse cold", "missed playback", "missed cold",
                             "spurious playback", "spurious cold"})
    EXPECT_EQ(finest.at(choice).at("points").size(), 2u) << choice;
  // Place of the detector, milliseconds, error, is it on the front?
  EXPECT_EQ(finest.at("missed cold").at("points").at(1),
            Json({1, 0.75, 1.0 / 200'000, true, "0.750", "0.00001"}));
  EXPECT_EQ(finest.at("cells").at(1).at(7), "200001");
  EXPECT_TRUE(finest.at("cells").at(2).is_null());
  EXPECT_THAT(finest.at("worse playback").at("left_out").get<std::string>(),
              testing::StartsWith("Not in the chart: fcl-obbrss"));
  const Json& body = charts.at("charts").at(0).at("body").at("worse playback");
  EXPECT_EQ(body.at("points").at(1), Json({1, 0.5, 2.0 / 15, true, "0.500", "0.13334"}));
}

TEST(PageData, StagesTimesAndErrorsStandThereForEveryChoice) {
  Json results = test::sample_results();
  results["runs"][0]["geometry"].update(
      {{"depth_kind", "convex-pair"},
       {"depth_judged", 4},
       {"depth_error_max", 0.5},
       {"depth_error_mean", 0.25},
       {"depth_error_histogram", {{{"from", 0.25}, {"below", 1.0}, {"count", 3}}}}});
  const Json report = data_of(results);
  const std::size_t choices = report.at("choices").size();
  for (const char* part : {"stages", "times", "graded"})
    EXPECT_EQ(report.at(part).size(), choices) << part;
  const Json& stages = report.at("stages").at(0);
  EXPECT_EQ(stages.at("bars"),
            Json::array({{"ffd-aabb-sphere2+tri", "hash", 1, 1.0 / 200'000, "< 0.01 %"}}));
  EXPECT_EQ(stages.at("stages"), Json::array({"hash"}));
  EXPECT_EQ(stages.at("sentences"), Json::array({"ffd-aabb-sphere2+tri loses 1: 1 in hash."}));
  EXPECT_EQ(stages.at("without_loss"), "");
  EXPECT_EQ(stages.at("table").at("rows").size(), 1u);
  const Json& times = report.at("times").at(0);
  EXPECT_EQ(times.at("playback").at("bars").at(0),
            Json({"ffd-aabb-sphere2+tri", nullptr, 0.125, 0.375, 0.5, 0.5}));
  EXPECT_EQ(times.at("cold").at("bars").at(1), Json({"fcl-aabb", 0.25, 0.75, 2.0, 3.0, 2.75}));
  EXPECT_EQ(times.at("cold").at("table").at("rows").size(), 2u);
  const Json& depth = report.at("graded").at(0).at(0);
  EXPECT_EQ(depth.at("title"), "Depth, convex-pair");
  EXPECT_EQ(
      depth.at("rows").dump(),
      R"([["fcl-aabb","convex-pair",4,250.0,null,500.0,[[250.0,500.0,3,0.75,"75.0 %"]],[]]])");
  EXPECT_EQ(depth.at("always_zero"), "");
}

TEST(PageData, LevelThatNobodyClaimsHasNoChart) {
  Json results = test::sample_results();
  for (Json& run : results["runs"])
    if (run.contains("levels")) run["levels"].erase("body");
  const Json report = data_of(results);
  EXPECT_EQ(report.at("levels").size(), 2u);
  EXPECT_FALSE(report.at("speed_error").at("charts").at(0).contains("body"));
}

TEST(SpeedErrorCharts, LevelLeavesOutWhoDoesNotClaimIt) {
  Json json = test::sample_results();
  json["runs"][1]["levels"].erase("body");
  const results::Results results = results::from_json(json);
  const SpeedError chart = SpeedErrorCharts(results::Index(results)).chart({.level = Level::kBody});
  ASSERT_EQ(chart.points.size(), 1u);
  EXPECT_EQ(chart.points[0].detector, "fcl-aabb");
  EXPECT_THAT(left_out_sentence(chart),
              testing::HasSubstr("ffd-aabb-sphere2+tri (does not claim level body)"));
}

}  // namespace
}  // namespace contactcheck::report
