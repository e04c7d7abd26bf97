#include "reference/report/hard_cases.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "reference/report/markdown.h"
#include "reference/report/terminal.h"
#include "reference/results/results_json.h"
#include "tests/reference/report/hard_results.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

results::Results hard_results() { return results::from_json(test::hard_results()); }

TEST(HardCases, AreCountedPerDetector) {
  const auto lines = hard_lines(hard_results());
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(lines[0], ElementsAre("exact", "triangle", "2 of 2", "6 of 6", "0", "0", "0", "0",
                                    "0.250", "0.250 one"));
  EXPECT_THAT(lines[1], ElementsAre("skin", "triangle", "0 of 2", "3 of 6", "1", "5", "0", "0",
                                    "0.250", "0.250 one"));
  EXPECT_THAT(lines[2],
              ElementsAre("crash", "-", "0 of 2", "0 of 0", "0", "0", "1", "1", "-", "-"));
}

TEST(HardCases, NameTheFirstValueThatGoesWrong) {
  const std::string text = hard_cases_markdown(hard_results());
  EXPECT_THAT(text, HasSubstr("| skin | 1e-9 | 0 missed, 3 spurious of 0 true | 2 of 3 | 0 | 5 |"));
  EXPECT_THAT(text, HasSubstr("| skin | 0 | 1 missed, 0 spurious of 4 true | 1 of 3 | 1 | 0 |"));
  EXPECT_THAT(text, HasSubstr("| crash | 1e-3 | signal 11 | - | - | - |"));
  EXPECT_THAT(text, Not(HasSubstr("| exact | 0 |")));
  EXPECT_THAT(text, HasSubstr("`one`: Two | plates. Parameter: gap, m, 3 values from 0 on. Hard "
                              "for: gaps. From: issue 7."));
}

TEST(HardCases, WithoutACaseThatIsToldAreRefused) {
  results::Results results = hard_results();
  results.runs[2].failed_frame = 3;
  EXPECT_THROW(hard_cases_markdown(results), InputError);
  results = hard_results();
  results.runs[1].per_frame.missed.pop_back();
  EXPECT_THROW(hard_cases_markdown(results), InputError);
}

TEST(HardCases, StandInBothReportsInPlaceOfASectionPerFamily) {
  EXPECT_THAT(markdown_report(hard_results()), HasSubstr("### Where they go wrong"));
  EXPECT_THAT(markdown_report(hard_results()), Not(HasSubstr("## one\n")));
  EXPECT_THAT(terminal_tables(hard_results(), false), HasSubstr("hard cases"));
  const results::Results sample = results::from_json(test::sample_results());
  EXPECT_THAT(hard_lines(sample), IsEmpty());
  EXPECT_EQ(hard_cases_markdown(sample), "");
}

}  // namespace
}  // namespace contactcheck
