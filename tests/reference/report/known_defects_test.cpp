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

Json group(const char* kind, const Json& values) {
  return {{"detector", "skin"}, {"scene", "one"}, {"kind", kind}, {"values", values}};
}

Json defect(int listed, int shown, bool other_version) {
  return {{"library", "fcl"},
          {"version", "0.7.0"},
          {"issue", "502"},
          {"kind", "missed"},
          {"sentence", "it | rounds"},
          {"detectors", {"skin", "hull"}},
          {"scenes", {"one"}},
          {"listed", listed},
          {"shown", shown},
          {"other_version", other_version}};
}

results::Results results_with(const Json& not_shown, const Json& unlisted) {
  Json results = test::hard_results();
  results["known_defects"] = {{"defects", Json::array({defect(3, 2, false), defect(0, 0, true)})},
                              {"not_shown", not_shown},
                              {"unlisted", unlisted}};
  return results::from_json(results);
}

results::Results surprising() {
  return results_with(Json::array({group("missed", {"0"})}),
                      Json::array({group("spurious", {"1e-9", "1e-3"})}));
}

TEST(KnownDefectsReport, CountsBothDirections) {
  const std::string text = known_defects_markdown(surprising());
  EXPECT_THAT(text, HasSubstr("Of 3 listed wrong answers that this run could show, 2 show and 1 do "
                              "not; 2 show that are not listed."));
  EXPECT_THAT(text,
              HasSubstr("| fcl 0.7.0 | 502 | missed | it \\| rounds | skin, hull | 1 | 2 of 3 "
                        "|"));
  EXPECT_THAT(text, HasSubstr("| 1 | other version |"));
  EXPECT_THAT(text, HasSubstr("| skin | one | missed | 0 |"));
  EXPECT_THAT(text, HasSubstr("| skin | one | spurious | 1e-9, 1e-3 |"));
}

TEST(KnownDefectsReport, IsSilentAboutWhatIsAsListed) {
  const std::string text = known_defects_markdown(results_with(Json::array(), Json::array()));
  EXPECT_THAT(text, Not(HasSubstr("not shown: ")));
  EXPECT_THAT(text, Not(HasSubstr("Shown, and not listed")));
}

TEST(KnownDefectsReport, StandsInBothReportsWhereResultsHaveOne) {
  EXPECT_THAT(markdown_report(surprising()), HasSubstr("## Known defects of libraries"));
  EXPECT_THAT(terminal_tables(surprising(), false),
              HasSubstr("shown, not listed:\n  skin  one  spurious  1e-9, 1e-3\n"));
  const results::Results without = results::from_json(test::hard_results());
  EXPECT_THAT(markdown_report(without), Not(HasSubstr("Known defects")));
  EXPECT_THAT(terminal_tables(without, false), Not(HasSubstr("known defects")));
}

}  // namespace
}  // namespace contactcheck::report
