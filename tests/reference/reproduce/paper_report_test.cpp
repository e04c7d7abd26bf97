#include "reference/reproduce/paper_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/reference/reproduce/sample_paper.h"

namespace contactcheck::reproduce {
namespace {

using test::sample_paper_text;
using test::tables_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

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

TEST(PaperMarkdown, IsThisText) {
  EXPECT_EQ(paper_markdown(tables_of(sample_paper_text()), hand_made()),
            R"(## What the paper's own numbers say

Doe, Roe: *A title*, A journal 12, 2001, doi 10.1/x.

Computed from the printed tables alone; nothing here was measured.

### What does not add up

- It is too small.

### What agrees

- It fits.

No table has times of two on tin (9 fps), so these averages cannot be checked.

### Every figure

| check | table | scene | method | computed | claimed | verdict |
|---|---|---|---|--:|--:|---|
| rest | Table 3 | s\|t | two | -1.500 ms | - | does not agree |
| gain | Table 3 | - | - | 34.5 % | 34.5 | agrees |
| ratio | Table 1 | - | - | 2.000 | - | - |

)");
}

TEST(PaperMarkdown, AHeadingWithoutSentencesIsLeftOut) {
  const PaperTables tables = tables_of(sample_paper_text());
  EXPECT_THAT(paper_markdown(tables, check_paper(tables)), Not(HasSubstr("does not add up")));
}

TEST(PaperMarkdown, OfTheRealPaperHasEverySentenceWithAVerdict) {
  const PaperTables tables = test::real_paper();
  const std::vector<PaperFinding> findings = check_paper(tables);
  const std::string text = paper_markdown(tables, findings);
  for (const PaperFinding& finding : findings) {
    if (finding.agrees) {
      EXPECT_THAT(text, HasSubstr("- " + finding.sentence + "\n"));
    }
  }
}

TEST(PaperJson, IsThisDocument) {
  EXPECT_EQ(paper_json(tables_of(sample_paper_text()), hand_made()).dump(2),
            R"({
  "source": {
    "authors": [
      "Doe",
      "Roe"
    ],
    "title": "A title",
    "journal": "A journal 12",
    "year": 2001,
    "doi": "10.1/x"
  },
  "findings": [
    {
      "topic": "rest",
      "table": "Table 3",
      "scene": "s|t",
      "method": "two",
      "sentence": "It is too small.",
      "claimed": null,
      "computed": -1.5,
      "unit": "ms",
      "agrees": false
    },
    {
      "topic": "gain",
      "table": "Table 3",
      "scene": null,
      "method": null,
      "sentence": "It fits.",
      "claimed": 34.5,
      "computed": 34.46,
      "unit": "%",
      "agrees": true
    },
    {
      "topic": "ratio",
      "table": "Table 1",
      "scene": null,
      "method": null,
      "sentence": "It is a figure.",
      "claimed": null,
      "computed": 2.0,
      "unit": "ratio",
      "agrees": null
    }
  ]
})");
}

TEST(PaperChecks, AreTheFiguresOfTheMarkdownEachWithItsSentence) {
  const report::TitledTable checks =
      checks_table(paper_json(tables_of(sample_paper_text()), hand_made()));
  EXPECT_EQ(checks.title, "Checks of the paper's own numbers");
  ASSERT_EQ(checks.columns.size(), 8u);
  EXPECT_EQ(checks.columns.back().title, "in words");
  EXPECT_THAT(
      checks.rows,
      ElementsAre(ElementsAre("rest", "Table 3", "s|t", "two", "-1.500 ms", "-", "does not agree",
                              "It is too small."),
                  ElementsAre("gain", "Table 3", "-", "-", "34.5 %", "34.5", "agrees", "It fits."),
                  ElementsAre("ratio", "Table 1", "-", "-", "2.000", "-", "-", "It is a figure.")));
}

TEST(PaperChecks, OwnNumbersNameThePaperAndCountContradictions) {
  const PaperTables tables = tables_of(sample_paper_text());
  EXPECT_EQ(own_numbers(paper_json(tables, hand_made())),
            "Doe, Roe: A title, A journal 12, 2001, doi 10.1/x. 3 checks by arithmetic alone; 1 "
            "contradict a claim or cannot be.");
}

}  // namespace
}  // namespace contactcheck::reproduce
