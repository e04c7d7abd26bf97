#include "reference/gate/output.h"

#include <gmock/gmock.h>

#include "tests/reference/gate/sample_checks.h"

namespace contactcheck::gate {
namespace {

TEST(Junit, IsASuitePerRuleAndACasePerCheck) {
  Check fail = test::broken_check("none missed", "lazy");
  fail.why = "all are promised";
  EXPECT_EQ(
      junit_xml(test::result_of({test::passed_check("none missed", "exact"), fail,
                                 test::open_check("fast", Verdict::kCannotJudge, "no baseline")})),
      R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuites name="contactcheck gate ci" tests="3" failures="1" errors="0" skipped="1">
  <testsuite name="none missed" tests="2" failures="1" errors="0" skipped="0">
    <testcase classname="none missed" name="touch exact"/>
    <testcase classname="none missed" name="touch lazy">
      <failure type="fail" message="touch  lazy: missed 3, allowed at most 0, frame 7">touch  lazy: missed 3, allowed at most 0, frame 7&#10;contactcheck run touch --detector lazy&#10;all are promised</failure>
    </testcase>
  </testsuite>
  <testsuite name="fast" tests="1" failures="0" errors="0" skipped="1">
    <testcase classname="fast" name="touch exact">
      <skipped message="cannot judge: touch  exact: no baseline"/>
    </testcase>
  </testsuite>
</testsuites>
)");
}

TEST(Junit, CaseOfAPatternThatMatchesNothingIsNamedByIt) {
  Check idle;
  idle.rule = "R";
  idle.verdict = Verdict::kFail;
  idle.red = true;
  idle.reason = "matches nothing: \"tuch\"";
  EXPECT_THAT(junit_xml(test::result_of({idle})),
              testing::HasSubstr("name=\"matches nothing: &quot;tuch&quot;\">"));
}

TEST(XmlEscaped, LeavesNothingThatXmlTakesApartOrRefuses) {
  EXPECT_EQ(xml_escaped("a<b>&\"c\"\n\t\x01\x1b"), "a&lt;b&gt;&amp;&quot;c&quot;&#10;&#9;??");
  EXPECT_EQ(xml_escaped("\xc3\xa4\xef\xbf\xbe\xef\xbf\xbf"), "\xc3\xa4??");
}

}  // namespace
}  // namespace contactcheck::gate
