#include "reference/report/tables/hard_cases.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/report/formats/page_data.h"
#include "reference/report/pictures/stability_plot.h"
#include "reference/results/results_json.h"
#include "tests/reference/report/hard_results.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck::report {
namespace {

using ::testing::ElementsAre;

results::Results read_hard_results() { return results::from_json(test::hard_results()); }

HeatTable matrix_of(const results::Results& results) {
  return hard_matrix(results::Index(results));
}

std::vector<std::string> texts_of(const std::vector<HeatCell>& row) {
  std::vector<std::string> texts;
  for (const HeatCell& cell : row) texts.push_back(cell.text);
  return texts;
}

TEST(HardCases, MatrixHasFamiliesAndDetectorsThatGoWrong) {
  const HeatTable matrix = matrix_of(read_hard_results());
  EXPECT_THAT(matrix.columns, ElementsAre("family", "cases", "skin", "crash"));
  ASSERT_EQ(matrix.rows.size(), 2u);
  EXPECT_THAT(texts_of(matrix.rows[0]), ElementsAre("one", "3", "2", "error"));
  EXPECT_THAT(texts_of(matrix.rows[1]), ElementsAre("two", "3", "1", "refused"));
  const HeatCell &skin = matrix.rows[0][2], &crash = matrix.rows[0][3];
  EXPECT_EQ(skin.share, 2.0 / 3);
  EXPECT_EQ(skin.label, "skin in one: 2 of 3 cases wrong");
  EXPECT_EQ(skin.kind, "");
  EXPECT_EQ(crash.share, std::nullopt);
  EXPECT_EQ(crash.label, "signal 11");
  EXPECT_EQ(crash.kind, "error");
}

TEST(HardCases, MatrixTellsRightFromNotJudgedAndNotAsked) {
  results::Results results = read_hard_results();
  results.runs[0].per_frame.missed[0] = 1;  // "exact" goes wrong, in family "one" alone
  HeatTable matrix = matrix_of(results);
  EXPECT_THAT(matrix.columns, ElementsAre("family", "cases", "exact", "skin", "crash"));
  EXPECT_EQ(matrix.rows[1][2].text, "·");
  EXPECT_EQ(matrix.rows[1][2].share, 0.0);
  results.runs[3].per_frame.level.reset();
  matrix = matrix_of(results);
  EXPECT_EQ(matrix.rows[1][2].text, "-");
  EXPECT_EQ(matrix.rows[1][2].kind, "aside");
  results.runs.erase(results.runs.begin() + 3);
  EXPECT_EQ(matrix_of(results).rows[1][2].text, "");
}

TEST(HardCases, SayWhoGoesWrongAndWhereToLook) {
  const results::Results results = read_hard_results();
  const std::vector<WrongFamily> families = wrong_families(results::Index(results));
  ASSERT_EQ(families.size(), 2u);
  EXPECT_EQ(families[0].scene.id, "one");
  EXPECT_EQ(families[0].aside, "2 detectors go wrong");
  EXPECT_EQ(families[1].aside, "1 detector goes wrong");
  EXPECT_EQ(families[0].sentence,
            "Parameter: gap, m, 3 values from 0 on. Hard for: gaps. From: issue 7.");
  ASSERT_EQ(families[0].shown.size(), 2u);
  EXPECT_EQ(families[0].shown[0]->detector, "skin");
  EXPECT_EQ(families[0].shown[0]->frame, 1u);
  EXPECT_EQ(families[0].shown[0]->kind, "spurious");
  EXPECT_EQ(families[0].shown[1]->frame, 2u) << "of the crash";
  EXPECT_EQ(families[0].shown[1]->kind, "");
  EXPECT_EQ(families[1].shown[0]->kind, "missed");
  results::Results unknown = results;
  unknown.runs[2].failed_frame.reset();
  EXPECT_FALSE(wrong_families(results::Index(unknown))[0].shown[1]);
}

TEST(HardCases, OfThePageAreThoseOfMarkdown) {
  const results::Results results = read_hard_results();
  const nlohmann::ordered_json hard = page_data(results, std::nullopt).at("hard");
  EXPECT_EQ(hard.at("sums").at("rows"),
            nlohmann::ordered_json(hard_sums(results::Index(results)).rows));
  EXPECT_EQ(hard.at("matrix").at("rows").at(1).dump(),
            R"([{"text":"two"},{"text":"3"},{"text":"1","share":0.3333333333333333,)"
            R"("label":"skin in two: 1 of 3 cases wrong"},)"
            R"({"text":"refused","label":"far","kind":"error"}])");
  const nlohmann::ordered_json& one = hard.at("families").at(0);
  EXPECT_EQ(one.at("id"), "one");
  EXPECT_EQ(one.at("title"), "Two | plates");
  EXPECT_EQ(one.at("table").at("rows").at(0).at(2), "0 missed, 3 spurious of 0 true");
  EXPECT_EQ(one.at("shown").dump(), R"([{"detector":"skin","frame":1,"kind":"spurious"},)"
                                    R"({"detector":"crash","frame":2}])");
  EXPECT_EQ(one.at("picture"),
            stability_plot(results.scenes[0], family_results(results::Index(results))));
  const results::Results sample = results::from_json(test::sample_results());
  EXPECT_FALSE(page_data(sample, std::nullopt).contains("hard"));
}

}  // namespace
}  // namespace contactcheck::report
