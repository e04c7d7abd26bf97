#include "reference/report/goals_table.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/report/markdown.h"
#include "reference/report/terminal.h"
#include "reference/results/results_json.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck::report {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

results::Results sample() { return results::from_json(test::sample_results()); }

results::Results with_goals() {
  Json results = test::sample_results();
  results["goals"] = Json::parse(R"([
    {"goal": "faster", "scene": "s", "detector": "d", "part": "playback", "over": "embree",
     "at_least": 12.0, "measured": 11.95, "low": 11.5, "high": 12.5, "unit": "x", "met": false},
    {"goal": "cheap", "scene": "s", "detector": "d", "part": "cold", "per": "pair",
     "at_most": 0.15, "measured": 0.125, "unit": "us", "met": true},
    {"goal": "wide", "scene": "t", "detector": "e", "part": "playback", "over": "d",
     "at_most": 1.4, "measured": null, "why": "e: not here", "met": null}])");
  return results::from_json(results);
}

TEST(GoalsTable, SaysWhatWasWantedMeasuredAndMet) {
  const auto lines = goals_table(with_goals()).rows;
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(lines[0],
              ElementsAre("faster", "s", "d", ">= 12.0x", "11.9x (11.5 to 12.5)", "-", "no"));
  EXPECT_THAT(lines[1], ElementsAre("cheap", "s", "d", "<= 0.150 us", "0.125 us", "-", "yes"));
  EXPECT_THAT(lines[2],
              ElementsAre("wide", "t", "e", "<= 1.40x", "-", "-", "not measured: e: not here"));
}

TEST(GoalsTable, SaysWhatTheEndsAreFromThePassesOfTheRow) {
  results::Results results = with_goals();
  results::MeasuredGoal& goal = results.goals[0];
  goal.scene = "hello";
  goal.detector = "ffd-aabb-sphere2+tri";
  goal.over = "fcl-aabb";
  TitledTable table = goals_table(results);
  EXPECT_EQ(table.rows[0][4], "11.9x [11.5, 12.5]");
  EXPECT_EQ(table.rows[0][5], "5");
  EXPECT_THAT(table.text, HasSubstr("[low, high] is the 95 % interval over 5 passes."));
  results.runs[1].speedup[Question::kTriangles]["fcl-aabb"].passes = 3;
  table = goals_table(results);
  EXPECT_EQ(table.rows[0][4], "11.9x (11.5 to 12.5)");
  EXPECT_EQ(table.rows[0][5], "3");
  EXPECT_THAT(table.text, Not(HasSubstr("95 %")));
}

TEST(GoalsTable, IsInBothReportsOfSuitesThatHaveGoalsAlone) {
  EXPECT_THAT(markdown_report(with_goals()), HasSubstr("## Goals of the suite"));
  EXPECT_THAT(terminal_tables(with_goals(), false), HasSubstr("not measured: e: not here"));
  EXPECT_THAT(goals_table(sample()).rows, IsEmpty());
  EXPECT_THAT(markdown_report(sample()), Not(HasSubstr("Goals")));
  EXPECT_THAT(terminal_tables(sample(), false), Not(HasSubstr("goals")));
}

}  // namespace
}  // namespace contactcheck::report
