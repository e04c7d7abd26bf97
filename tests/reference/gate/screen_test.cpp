#include "reference/gate/output.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/reference/gate/sample_checks.h"

namespace contactcheck::gate {
namespace {

using test::broken_check;
using test::open_check;
using test::result_of;
using testing::HasSubstr;
using testing::Not;

TEST(Screen, OfAGreenGateIsThreeLines) {
  EXPECT_EQ(gate_screen(result_of({test::passed_check("none missed", "exact")}), false),
            "ci  A fast run\n"
            "1 checks of 2 rules: 1 pass, 0 fail, 0 too noisy to judge, 0 cannot judge\n"
            "gate: green\n");
}

TEST(Screen, NamesEachBrokenRuleWithItsCommandAndWhatIsOpen) {
  Check first = broken_check("none missed", "exact");
  first.why = "exact is exact";
  const std::string text = gate_screen(
      result_of({first, broken_check("none missed", "lazy"), broken_check("none missed", "refit"),
                 open_check("fast", Verdict::kTooNoisy, "wide"),
                 open_check("as fast as it was", Verdict::kCannotJudge, "another machine"),
                 open_check("as fast as it was", Verdict::kCannotJudge, "another machine")}),
      false);
  EXPECT_EQ(
      text,
      "ci  A fast run\n"
      "6 checks of 2 rules: 0 pass, 3 fail, 1 too noisy to judge, 2 cannot judge (of 1 rule)\n"
      "FAIL  none missed\n"
      "  (exact is exact)\n"
      "  touch  exact: missed 3, allowed at most 0, frame 7\n"
      "    contactcheck run touch --detector exact\n"
      "  touch  lazy: missed 3, allowed at most 0, frame 7\n"
      "    contactcheck run touch --detector lazy\n"
      "  ... and 1 more of this rule\n"
      "too noisy to judge\n"
      "  fast: touch  exact: wide\n"
      "cannot judge\n"
      "  as fast as it was: touch  exact: another machine; and 1 more\n"
      "gate: red\n");
}

TEST(Screen, ShowsWhatThePolicyMakesRedAmongTheBrokenRules) {
  Check noisy = open_check("fast", Verdict::kTooNoisy, "wide");
  noisy.red = true;
  const std::string text = gate_screen(result_of({noisy}), false);
  EXPECT_THAT(text, HasSubstr("FAIL  fast\n  touch  exact: too noisy to judge: wide\n"));
  EXPECT_THAT(text, HasSubstr("gate: red\n"));
}

TEST(Screen, OfAThousandBreachesIsOneScreen) {
  std::vector<Check> checks;
  for (int rule = 0; rule < 100; ++rule)
    for (int row = 0; row < 10; ++row)
      checks.push_back(broken_check("rule " + std::to_string(rule), "d" + std::to_string(row)));
  const std::string text = gate_screen(result_of(checks), false);
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 55);
  EXPECT_THAT(text, HasSubstr("1000 fail"));
  EXPECT_THAT(text, HasSubstr("  ... and 92 more broken rules\n"));
}

TEST(Screen, IsColouredForATerminalAlone) {
  const GateResult result = result_of({broken_check("none missed", "exact")});
  EXPECT_THAT(gate_screen(result, true), HasSubstr("\x1b[31mFAIL\x1b[0m"));
  EXPECT_THAT(gate_screen(result, false), Not(HasSubstr("\x1b")));
}

}  // namespace
}  // namespace contactcheck::gate
