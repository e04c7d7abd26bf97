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

TEST(GithubAnnotations, EscapeWhatTheRunnerTakesApart) {
  EXPECT_EQ(github_annotations(result_of({broken_check("100 %: a, b", "d:x=1,y=2")})),
            "::error title=100 %25%3A a%2C b::touch  d:x=1,y=2: missed 3, allowed at most 0, "
            "frame 7%0Acontactcheck run touch --detector d:x=1,y=2\n");
}

TEST(GithubAnnotations, AreWarningsAndNoticesForWhatIsOpen) {
  const Check noisy = open_check("fast", Verdict::kTooNoisy, "wide");
  const Check unjudged = open_check("slow", Verdict::kCannotJudge, "elsewhere");
  EXPECT_EQ(github_annotations(result_of({noisy, unjudged, unjudged})),
            "::warning title=fast::too noisy to judge: touch  exact: wide\n"
            "::notice title=slow::cannot judge: touch  exact: elsewhere; and 1 more\n");
}

TEST(GithubAnnotations, AreTenAtMostOfWhichTheLastCounts) {
  std::vector<Check> checks;
  for (int i = 0; i < 10; ++i) checks.push_back(broken_check("R", "d" + std::to_string(i)));
  std::string text = github_annotations(result_of(checks));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_THAT(text, HasSubstr("touch  d9"));
  checks.push_back(broken_check("R", "d10"));
  text = github_annotations(result_of(checks));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_THAT(text, Not(HasSubstr("touch  d9")));
  EXPECT_THAT(text, HasSubstr("::and 2 more; the job summary lists them\n"));
}

TEST(GithubSummary, IsATableOfWhatIsRedAndAListOfWhatIsOpen) {
  const Check red = broken_check("a|b", "d<1>");
  const Check open = open_check("slow", Verdict::kCannotJudge, "elsewhere");
  EXPECT_EQ(github_summary(result_of({red, open})),
            "## contactcheck gate ci: red\n\n"
            "A fast run. 2 checks of 2 rules: 0 pass, 1 fail, 0 too noisy to judge, 1 cannot "
            "judge (of 1 rule).\n\n"
            "| rule | scene | detector | measured | allowed | frame | remark | again |\n"
            "|---|---|---|---|---|---|---|---|\n"
            "| a\\|b | touch | d&lt;1> | missed 3 | at most 0 | frame 7 |  | "
            "`contactcheck run touch --detector d<1>` |\n\n"
            "- slow, cannot judge:\n"
            "  - touch  exact: elsewhere\n");
}

TEST(GithubSummary, OfAGreenGateHasNoTable) {
  EXPECT_EQ(github_summary(result_of({})),
            "## contactcheck gate ci: green\n\n"
            "A fast run. 0 checks of 2 rules: 0 pass, 0 fail, 0 too noisy to judge, 0 cannot "
            "judge.\n\n");
}

}  // namespace
}  // namespace contactcheck::gate
