#include "reference/reproduce/paper_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/reference/reproduce/sample_paper.h"

namespace contactcheck::reproduce {
namespace {

using test::sample_paper_text;
using test::tables_of;

std::vector<PaperFinding> hand_made() {
  return {{.topic = "rest",
           .table = "Table 3",
           .scene = "s|t",
           .method = "two",
           .sentence = "It is too small.",
           .computed = -1.5,
           .unit = "ms",
           .agrees = false},
          {.topic = "gain",
           .table = "Table 3",
           .sentence = "It fits.",
           .claimed = 34.5,
           .computed = 34.46,
           .unit = "%",
           .agrees = true},
          {.topic = "ratio",
           .table = "Table 1",
           .sentence = "It is a figure.",
           .computed = 2.0,
           .unit = "ratio"}};
}

TEST(PaperChecks, AreTheFiguresOfTheMarkdownEachWithItsSentence) {
  const report::TitledTable checks =
      checks_table(paper_json(tables_of(sample_paper_text()), hand_made()));
  EXPECT_EQ(checks.title, "Checks of the paper's own numbers");
  ASSERT_EQ(checks.columns.size(), 8u);
  EXPECT_EQ(checks.columns.back().title, "in words");
  const std::vector<std::vector<std::string>> rows = {
      {"rest", "Table 3", "s|t", "two", "-1.500 ms", "-", "does not agree", "It is too small."},
      {"gain", "Table 3", "-", "-", "34.5 %", "34.5", "agrees", "It fits."},
      {"ratio", "Table 1", "-", "-", "2.000", "-", "-", "It is a figure."}};
  EXPECT_EQ(checks.rows, rows);
}

TEST(PaperChecks, OwnNumbersNameThePaperAndCountContradictions) {
  const PaperTables tables = tables_of(sample_paper_text());
  EXPECT_EQ(own_numbers(paper_json(tables, hand_made())),
            "Doe, Roe: A title, A journal 12, 2001, doi 10.1/x. 3 checks by arithmetic alone; 1 "
            "contradict a claim or cannot be.");
}

}  // namespace
}  // namespace contactcheck::reproduce
