#include "reference/report/known_defects.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/report/markdown.h"
#include "reference/report/terminal.h"
#include "reference/results/results_json.h"
#include "tests/reference/report/hard_results.h"

namespace contactcheck::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::Not;

Json group(const char* kind, const Json& values, const Json& was, const Json& is) {
  return {{"detector", "skin"}, {"scene", "one"}, {"kind", kind},
          {"values", values},   {"was", was},     {"is", is}};
}

Json defect(int listed, int shown, int changed, bool other_version) {
  return {{"library", "fcl"},
          {"version", "0.7.0"},
          {"where", "overlap()"},
          {"upstream", "https://example.org/issues/502"},
          {"kind", "missed"},
          {"sentence", "it | rounds"},
          {"detectors", {"skin", "hull"}},
          {"scenes", {"one"}},
          {"listed", listed},
          {"shown", shown},
          {"changed", changed},
          {"other_version", other_version}};
}

results::Results results_with(const Json& changed, const Json& not_shown, const Json& unlisted) {
  Json results = test::hard_results();
  Json reading = defect(9, 9, 2, false);
  reading["library"] = "contactcheck";
  reading["where"] = "section 3";
  results["known_defects"] = {
      {"defects", Json::array({defect(4, 3, 1, false), defect(0, 0, 0, true)})},
      {"readings", Json::array({reading})},
      {"changed", changed},
      {"not_shown", not_shown},
      {"unlisted", unlisted}};
  return results::from_json(results);
}

results::Results surprising() {
  const Json none = Json::array();
  return results_with(Json::array({group("missed", {"1e-3"}, {1}, {1000000})}),
                      Json::array({group("missed", {"0"}, {12}, none)}),
                      Json::array({group("spurious", {"1e-9", "1e-3"}, none, {4, 5}),
                                   group("refused", {"1e-3"}, none, {1})}));
}

TEST(KnownDefectsReport, CountsBothDirections) {
  const std::string text = known_defects_markdown(surprising());
  EXPECT_THAT(text, HasSubstr("Of 4 listed wrong answers of libraries that this run could show, 2 "
                              "show as listed, 1 with another count and 1 do not. Of 9 wrong "
                              "answers expected of our readings of the paper that this run could "
                              "show, 7 show as listed, 2 with another count and 0 do not. 3 show "
                              "that are not listed."));
  EXPECT_THAT(text, HasSubstr("| fcl 0.7.0 | overlap() | https://example.org/issues/502 | missed | "
                              "it \\| rounds | skin, hull | 1 | 3 of 4, 1 with another count |"));
  EXPECT_THAT(text, HasSubstr("| section 3 | missed | it \\| rounds | skin, hull | 1 | 9 of 9, 2 "
                              "with another count |"));
  EXPECT_THAT(text, HasSubstr("| 1 | other version |"));
  EXPECT_THAT(text, HasSubstr("| skin | one | missed | 1e-3: 1 -> 1,000,000 |"));
  EXPECT_THAT(text, HasSubstr("| skin | one | missed | 0: 12 |"));
  EXPECT_THAT(text, HasSubstr("| skin | one | spurious | 1e-9: 4; 1e-3: 5 |"));
  EXPECT_THAT(text, HasSubstr("| skin | one | refused | 1e-3 |"));
}

TEST(KnownDefectsReport, IsSilentAboutWhatIsAsListed) {
  const std::string text =
      known_defects_markdown(results_with(Json::array(), Json::array(), Json::array()));
  EXPECT_THAT(text, Not(HasSubstr("Shown with another count")));
  EXPECT_THAT(text, Not(HasSubstr("not shown: ")));
  EXPECT_THAT(text, Not(HasSubstr("Shown, and not listed")));
}

TEST(KnownDefectsReport, StandsInBothReportsWhereResultsHaveOne) {
  EXPECT_THAT(markdown_report(surprising()), HasSubstr("## Known wrong answers"));
  EXPECT_THAT(
      terminal_tables(surprising(), false),
      HasSubstr("count changed (listed -> shown):\n  skin  one  missed  1e-3: 1 -> 1,000,000\n"
                "listed, not shown:\n  skin  one  missed  0: 12\n"
                "shown, not listed:\n  skin  one  spurious  1e-9: 4; 1e-3: 5\n"));
  const results::Results without = results::from_json(test::hard_results());
  EXPECT_THAT(markdown_report(without), Not(HasSubstr("Known wrong answers")));
  EXPECT_THAT(terminal_tables(without, false), Not(HasSubstr("known defects")));
}

}  // namespace
}  // namespace contactcheck::report
