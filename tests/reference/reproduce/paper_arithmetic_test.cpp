// The arithmetic on the paper's numbers: on the real ones against a transcription made apart
// (fixtures/paper/checked.json), on made-up ones for each verdict.
#include "reference/reproduce/paper_arithmetic.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "reference/text/file_text.h"
#include "reference/text/json_field.h"
#include "tests/reference/reproduce/sample_paper.h"

namespace contactcheck::reproduce {
namespace {

using test::real_paper;
using test::replaced;
using test::sample_paper_text;
using test::select;
using test::tables_of;
using testing::ElementsAre;
using testing::IsEmpty;

const std::string kCheckedName = "checked.json";

text::JsonValue checked_figures() {
  return text::parse_json(
      text::read_file_bytes(std::filesystem::path(CONTACTCHECK_FIXTURES) / "paper" / kCheckedName,
                            "checked file"),
      kCheckedName);
}

std::string text_or_empty(const text::JsonField& object, const char* key) {
  return object.has(key) ? object.at(key).text() : "";
}

// `value` with as many decimals as `wanted` has.
std::string as_written(double value, const std::string& wanted) {
  const std::size_t point = wanted.find('.');
  const std::size_t decimals = point == std::string::npos ? 0 : wanted.size() - point - 1;
  return fmt::format("{:.{}f}", value, decimals);
}

// The one finding that a figure is about: among several, the smallest or the largest.
const PaperFinding* picked(const std::vector<PaperFinding>& found, const std::string& pick) {
  const auto less = [](const PaperFinding& a, const PaperFinding& b) {
    return a.computed < b.computed;
  };
  if (found.empty() || (pick.empty() && found.size() != 1)) return nullptr;
  return pick == "largest" ? &*std::max_element(found.begin(), found.end(), less)
                           : &*std::min_element(found.begin(), found.end(), less);
}

void expect_figure(const std::vector<PaperFinding>& findings, const text::JsonField& figure) {
  SCOPED_TRACE(figure.path());
  figure.only_keys({"topic", "table", "scene", "method", "pick", "value", "claimed", "agrees"});
  const std::vector<PaperFinding> found =
      select(findings, figure.at("topic").text(), text_or_empty(figure, "table"),
             text_or_empty(figure, "scene"), text_or_empty(figure, "method"));
  const PaperFinding* finding = picked(found, text_or_empty(figure, "pick"));
  ASSERT_NE(finding, nullptr) << found.size() << " findings";
  const std::string value = figure.at("value").text();
  EXPECT_EQ(as_written(finding->computed, value), value);
  const std::string claimed = text_or_empty(figure, "claimed");
  ASSERT_EQ(finding->claimed.has_value(), !claimed.empty());
  if (!claimed.empty()) {
    EXPECT_EQ(as_written(*finding->claimed, claimed), claimed);
  }
  ASSERT_EQ(finding->agrees.has_value(), figure.has("agrees"));
  if (finding->agrees) {
    EXPECT_EQ(*finding->agrees, figure.at("agrees").value().boolean);
  }
}

TEST(PaperArithmetic, GivesEveryFigureOfTheTranscription) {
  const text::JsonValue value = checked_figures();
  const text::JsonField root(value, kCheckedName);
  const std::vector<PaperFinding> findings = check_paper(real_paper());
  const std::vector<text::JsonField> figures = root.at("figures").items(1);
  for (const text::JsonField& figure : figures) expect_figure(findings, figure);
}

TEST(PaperArithmetic, CountsPerObjectAreThoseOfTheTranscription) {
  const text::JsonValue value = checked_figures();
  const text::JsonField root(value, kCheckedName);
  const std::vector<text::JsonField> wanted = root.at("per_object").items(1);
  const PaperTables tables = real_paper();
  ASSERT_EQ(wanted.size(), tables.scenes.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    SCOPED_TRACE(wanted[i].path());
    const PaperScene& scene = tables.scenes[i];
    EXPECT_EQ(wanted[i].at("scene").text(), scene.id);
    const auto expect_count = [&](const char* key, std::size_t count) {
      const std::string text = wanted[i].at(key).text();
      EXPECT_EQ(as_written(static_cast<double>(count) / static_cast<double>(scene.objects), text),
                text);
    };
    expect_count("vertices", scene.vertices);
    expect_count("triangles", scene.triangles);
    expect_count("cells", scene.cells);
  }
}

TEST(PaperArithmetic, TotalsMadeOfTheirPartsAgree) {
  PaperTables tables = real_paper();
  for (PaperRow& row : tables.table_3.rows) row.total = row.steps();
  const std::vector<PaperFinding> findings = check_paper(tables);
  const std::vector<PaperFinding> rests = select(findings, "rest", "Table 3");
  EXPECT_EQ(rests.size(), tables.table_3.rows.size());
  for (const PaperFinding& rest : rests) EXPECT_EQ(rest.agrees, true) << rest.sentence;
  const std::vector<PaperFinding> below = select(findings, "totals-below-parts", "Table 3");
  ASSERT_EQ(below.size(), 1u);
  EXPECT_EQ(below[0].computed, 0.0);
  EXPECT_EQ(below[0].agrees, true);
  for (const PaperFinding& limit : select(findings, "gain-limit"))
    EXPECT_EQ(limit.agrees, true) << limit.sentence;
}

// Topics with a verdict of `wanted`, each once.
std::set<std::string> topics(const std::vector<PaperFinding>& findings, bool wanted) {
  std::set<std::string> out;
  for (const PaperFinding& finding : findings)
    if (finding.agrees == wanted) out.insert(finding.topic);
  return out;
}

TEST(PaperArithmetic, AConsistentPaperAgreesWithItself) {
  const std::vector<PaperFinding> findings = check_paper(tables_of(sample_paper_text()));
  EXPECT_THAT(topics(findings, false), IsEmpty());
  EXPECT_THAT(
      topics(findings, true),
      ElementsAre("average-frame-rate", "best-frame-rate", "cell-share", "frame-rate-gain-by-parts",
                  "frame-rate-gain-by-totals", "gain-limit", "objects", "one-level-gain", "rest",
                  "test-share", "test-share-mean", "totals-below-parts"));
}

TEST(PaperArithmetic, FiguresOfAConsistentPaper) {
  const std::vector<PaperFinding> findings = check_paper(tables_of(sample_paper_text()));
  const auto computed = [&](const std::string& topic, const std::string& table) {
    const std::vector<PaperFinding> found = select(findings, topic, table);
    EXPECT_EQ(found.size(), 1u) << topic;
    return found.empty() ? 0.0 : found[0].computed;
  };
  EXPECT_EQ(computed("test-ratio", "Table 3"), 2.0);
  EXPECT_EQ(computed("total-ratio", "Table 3"), 1.5);
  EXPECT_EQ(computed("test-ratio", "Table 1"), 2.0);
  EXPECT_EQ(computed("total-ratio", "Table 1"), 2.0);
  EXPECT_EQ(computed("gain-limit", "Table 3"), 3.0);
  EXPECT_EQ(computed("frame-rate-gain-by-totals", "Table 3"), 50.0);
  EXPECT_NEAR(computed("frame-rate-gain-by-parts", "Table 3"), 100.0 * 20.0 / 35.0, 1e-12);
  EXPECT_EQ(computed("test-saving", "Table 3"), 20.0);
  EXPECT_EQ(computed("average-frame-rate", "Table 3"), 25.0);
  EXPECT_EQ(computed("one-level-gain", "Table 1"), 100.0);
  EXPECT_EQ(computed("euler-characteristic", "Table 2"), 4.0);
}

TEST(PaperArithmetic, MeansAreOverScenesAndOfTheirKind) {
  const std::string text = replaced(
      replaced(sample_paper_text(), R"("response": 4, "total": 40}]})",
               R"("response": 4, "total": 40},
    {"scene": "t", "method": "one", "mss": 1, "cell": 1, "test": 16, "response": 1, "total": 20},
    {"scene": "t", "method": "two", "mss": 1, "cell": 1, "test": 2, "response": 1, "total": 8}]})"),
      R"("cells": 7})",
      R"("cells": 7}, {"scene": "t", "objects": 1, "vertices": 4, "triangles": 4, "cells": 1})");
  const std::vector<PaperFinding> findings = check_paper(tables_of(text));
  const auto geometric = select(findings, "test-ratio-geometric-mean", "Table 3");
  const auto arithmetic = select(findings, "test-ratio-arithmetic-mean", "Table 3");
  ASSERT_EQ(geometric.size(), 1u);
  ASSERT_EQ(arithmetic.size(), 1u);
  EXPECT_NEAR(geometric[0].computed, 4.0, 1e-12);  // of 2 and 8
  EXPECT_EQ(arithmetic[0].computed, 5.0);
}

// One change of the consistent paper, and the topics that then contradict it.
struct Change {
  std::string name, from, to;
  std::set<std::string> contradictions;
};
void PrintTo(const Change& p, std::ostream* out) { *out << p.name; }

class ChangedPaper : public ::testing::TestWithParam<Change> {};

TEST_P(ChangedPaper, ContradictsItselfWhereItShould) {
  const Change& change = GetParam();
  const std::string text = replaced(sample_paper_text(), change.from, change.to);
  EXPECT_EQ(topics(check_paper(tables_of(text)), false), change.contradictions);
}

// Parts of rows that several changes replace.
const std::string kOneLevel = R"("test": 40, "response": 4, "total": 60)";
const std::string kOneLevelOfTable1 = R"("response": 5, "total": 50)";

// Printed times: five figures are off by 0.0025 ms at most, three by 0.0015 ms.
INSTANTIATE_TEST_SUITE_P(
    Verdicts, ChangedPaper,
    ::testing::Values(
        Change{"RestWithinRounding", kOneLevelOfTable1, R"("response": 5, "total": 49.9976)", {}},
        Change{"RestBeyondRounding",
               R"("test": 25, "response": 5, "total": 50)",
               R"("test": 25, "response": 5.0026, "total": 50)",
               {"rest", "totals-below-parts"}},
        // A cheap test before leaves little to gain, also by the parts.
        Change{"GainAtItsLimit",
               kOneLevel,
               R"("test": 21.5, "response": 4, "total": 61.5014)",
               {"frame-rate-gain-by-parts"}},
        Change{"GainBeyondItsLimit",
               kOneLevel,
               R"("test": 21.5, "response": 4, "total": 61.5016)",
               {"frame-rate-gain-by-parts", "gain-limit"}},
        Change{"GainClaim",
               R"("low": 50, "high": 60)",
               R"("low": 51, "high": 60)",
               {"frame-rate-gain-by-totals"}},
        Change{"GainClaimByParts",
               R"("low": 50, "high": 60)",
               R"("low": 50, "high": 57)",
               {"frame-rate-gain-by-parts"}},
        Change{"AverageRate",
               R"("value": 25, "low": 24.5)",
               R"("value": 25.3, "low": 25.2)",
               {"average-frame-rate"}},
        Change{"BestRate",
               R"("best_frame_rate": {"says": "25 fps", "value": 25, "low": 24.5, "high": 25.5})",
               R"("best_frame_rate": {"says": "26 fps", "value": 26, "low": 25.5, "high": 26.5})",
               {"best-frame-rate"}},
        Change{"BestDevice",
               R"("best_device": "box")",
               R"("best_device": "tin")",
               {"best-frame-rate"}},
        Change{"OneRowsShare",
               R"("test": 25, "response": 5)",
               R"("test": 21, "response": 5)",
               {"test-share", "test-share-mean"}},
        Change{
            "CellShare", R"("cell": 1, "test": 20)", R"("cell": 2.01, "test": 20)", {"cell-share"}},
        Change{"OneLevelGain",
               R"("value": 100, "low": 95)",
               R"("value": 101, "low": 100.1)",
               {"one-level-gain"}},
        Change{"Objects", R"("objects_in_text": 2)", R"("objects_in_text": 3)", {"objects"}},
        Change{"ObjectsNotClosed", R"("vertices": 20)", R"("vertices": 21)", {"objects"}}),
    [](const ::testing::TestParamInfo<Change>& test) { return test.param.name; });

TEST(PaperArithmetic, SentencesCarryTheComputedNumbers) {
  const std::vector<PaperFinding> findings = check_paper(tables_of(replaced(
      sample_paper_text(), R"("test": 20, "response": 4)", R"("test": 20, "response": 14.25)")));
  const std::vector<PaperFinding> rest = select(findings, "rest", "Table 3", "s", "two");
  ASSERT_EQ(rest.size(), 1u);
  EXPECT_EQ(rest[0].sentence,
            "Table 3, s, two: the four steps add up to 45.250 ms, and the total of 40.000 ms is "
            "5.250 ms smaller than that sum.");
  const std::vector<PaperFinding> below = select(findings, "totals-below-parts", "Table 3");
  ASSERT_EQ(below.size(), 1u);
  EXPECT_EQ(below[0].sentence,
            "Table 3: 1 of 2 totals are smaller than the sum of their own parts: s with two.");
}

TEST(PaperArithmetic, ASceneWithoutAnObjectCountInTheTextHasNoFinding) {
  const std::vector<PaperFinding> findings =
      check_paper(tables_of(replaced(sample_paper_text(), R"("objects_in_text": 2,)", "")));
  EXPECT_THAT(select(findings, "objects"), IsEmpty());
}

}  // namespace
}  // namespace contactcheck::reproduce
