#include "reference/report/hard_cases.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/report/markdown.h"
#include "reference/report/terminal.h"
#include "tests/reference/report/hard_results.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;
using test::hard_results;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

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

TEST(HardCases, WithCountsThatAreNoneAreRefused) {
  for (const char* kind : {"truth", "missed", "spurious"}) {
    Json results = hard_results();
    results["runs"][1]["per_frame"][kind][1] = 1e300;
    EXPECT_THROW(hard_cases_markdown(results), Json::exception) << kind;
  }
  for (const Json& frame : {Json(1e300), Json(-1), Json(3)}) {
    Json results = hard_results();
    results["runs"][2]["failed_frame"] = frame;
    EXPECT_THROW(hard_cases_markdown(results), Json::exception) << frame;
  }
}

TEST(HardCases, StandInBothReportsInPlaceOfASectionPerFamily) {
  EXPECT_THAT(markdown_report(hard_results()), HasSubstr("### Where they go wrong"));
  EXPECT_THAT(markdown_report(hard_results()), Not(HasSubstr("## one\n")));
  EXPECT_THAT(terminal_tables(hard_results(), false), HasSubstr("hard cases"));
  EXPECT_THAT(hard_lines(test::sample_results()), IsEmpty());
  EXPECT_EQ(hard_cases_markdown(test::sample_results()), "");
}

}  // namespace
}  // namespace contactcheck
