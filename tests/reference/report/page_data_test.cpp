#include "reference/report/page_data.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/report/speed_error.h"
#include "reference/report/summary.h"
#include "reference/results/results_json.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

Json data_of(const Json& results) { return page_data(results::from_json(results), nullptr); }

TEST(PageData, HoldsResultsAndReproductionAsTheyAre) {
  const results::Results results = results::from_json(test::sample_results());
  Json data = page_data(results, {{"schema", "contactcheck-reproduction/1"}});
  EXPECT_EQ(data.at("reproduction").at("schema"), "contactcheck-reproduction/1");
  data.erase("reproduction");
  data.erase("report");
  EXPECT_EQ(data, results::to_json(results));
  EXPECT_FALSE(data_of(test::sample_results()).contains("reproduction"));
}

TEST(PageData, SummaryIsThatOfTheOtherReports) {
  const Json summary = data_of(test::sample_results()).at("report").at("summary");
  EXPECT_EQ(summary.at("rows"), Json(summary_lines(results::from_json(test::sample_results()))));
  EXPECT_EQ(summary.at("columns").size(), summary.at("rows").at(0).size());
}

TEST(PageData, GoalsPairsAndKnownDefectsAreTables) {
  results::Results results = results::from_json(test::sample_results());
  Json report = page_data(results, nullptr).at("report");
  EXPECT_TRUE(report.at("goals").at("rows").empty());
  EXPECT_TRUE(report.at("pairs").empty());
  EXPECT_FALSE(report.contains("known_defects"));
  results.goals.resize(2);
  results.goals[0].at_most = 5.0;
  results.goals[0].met = false;
  results.scenes[0].pairs.emplace().per_kind = {{"sliver", {4, 1}}};
  results.known_defects.emplace().unlisted = {{"fcl-aabb", "gap", "missed", {"0", "1e-9"}}};
  report = page_data(results, nullptr).at("report");
  EXPECT_EQ(report.at("goals").at("rows").size(), 2u);
  EXPECT_EQ(report.at("goals").at("rows").at(0).back(), "no");
  EXPECT_EQ(report.at("pairs").at(0).at("scene"), "hello");
  EXPECT_EQ(report.at("pairs").at(0).at("table").at("rows").dump(),
            R"([["sliver","4","1","0.250"]])");
  const Json& known = report.at("known_defects");
  EXPECT_THAT(known.at("sentence").get<std::string>(),
              testing::HasSubstr("2 show that are not listed"));
  ASSERT_EQ(known.at("tables").size(), 1u);
  EXPECT_EQ(known.at("tables").at(0).at("rows").dump(),
            R"([["fcl-aabb","gap","missed","0, 1e-9"]])");
}

TEST(PageData, ClaimsAreThoseOfTheMarkdownReport) {
  const Json claims = data_of(test::sample_results()).at("report").at("claims");
  ASSERT_EQ(claims.size(), 1u);
  EXPECT_EQ(claims.at(0).at("title"),
            "ffd-aabb-sphere2+tri against FCL and Embree, question `triangles`");
  EXPECT_EQ(claims.at(0).at("columns").size(), 8u);
  EXPECT_EQ(claims.at(0).at("rows").at(0).at(3), "4.00x [3.50, 4.25]");
}

TEST(PageData, SumsAreOfClaimedLevelsAlone) {
  Json results = test::sample_results();
  results["runs"][1]["levels"]["body"]["informative"] = true;
  const Json report = data_of(results).at("report");
  EXPECT_EQ(report.at("levels"), Json({"body", "triangle"}));
  EXPECT_EQ(report.at("sums").at("triangle").at(1).at("spurious"), 2);
  EXPECT_EQ(report.at("sums").at("finest").at(1), report.at("sums").at("triangle").at(1));
  EXPECT_EQ(report.at("sums").at("body").at(0).at("hit"), 13);
  EXPECT_TRUE(report.at("sums").at("body").at(1).is_null());
}

TEST(PageData, SumsOfDifferentLevelsAreNone) {
  Json results = test::sample_results();
  Json scene = results["scenes"][0], run = results["runs"][0];
  scene["id"] = run["scene"] = "second";
  run["per_frame"]["level"] = "body";
  results["scenes"].push_back(scene);
  results["runs"].push_back(run);
  const Json sums = data_of(results).at("report").at("sums");
  EXPECT_EQ(sums.at("finest").at(0), "levels differ");
  EXPECT_EQ(sums.at("body").at(0).at("truth"), 26);
}

TEST(PageData, EveryChoiceOfTheChartHasItsPoints) {
  const Json charts = data_of(test::sample_results()).at("report").at("speed_error");
  EXPECT_EQ(charts.at("scenes"), Json({"scene hello"}));
  const Json& finest = charts.at("charts").at(0).at("finest");
  for (const char* choice :
       {"worse cold", "worse hot", "missed cold", "missed hot", "spurious cold", "spurious hot"})
    EXPECT_EQ(finest.at(choice).at("points").size(), 2u) << choice;
  // Place of the detector, milliseconds, error, is it on the front?
  EXPECT_EQ(finest.at("missed hot").at("points").at(1), Json({1, 0.25, 1.0 / 200'000, true}));
  EXPECT_EQ(finest.at("counts").at(1).at("reported"), 200'001);
  EXPECT_THAT(finest.at("worse cold").at("left_out").get<std::string>(),
              testing::StartsWith("Not in the chart: fcl-obbrss"));
  const Json& body = charts.at("charts").at(0).at("body").at("worse cold");
  EXPECT_EQ(body.at("points").at(1), Json({1, 0.5, 2.0 / 15, true}));
}

TEST(PageData, LevelThatNobodyClaimsHasNoChart) {
  Json results = test::sample_results();
  for (Json& run : results["runs"])
    if (run.contains("levels")) run["levels"].erase("body");
  const Json report = data_of(results).at("report");
  EXPECT_EQ(report.at("levels"), Json({"triangle"}));
  EXPECT_FALSE(report.at("speed_error").at("charts").at(0).contains("body"));
}

TEST(SpeedErrorCharts, LevelLeavesOutWhoDoesNotClaimIt) {
  Json json = test::sample_results();
  json["runs"][1]["levels"].erase("body");
  const results::Results results = results::from_json(json);
  const SpeedError chart = SpeedErrorCharts(results).chart({.level = Level::kBody});
  ASSERT_EQ(chart.points.size(), 1u);
  EXPECT_EQ(chart.points[0].detector, "fcl-aabb");
  EXPECT_THAT(left_out_sentence(chart),
              testing::HasSubstr("ffd-aabb-sphere2+tri (does not claim level body)"));
}

}  // namespace
}  // namespace contactcheck
