#include <gmock/gmock.h>

#include <set>

#include "reference/report/html.h"
#include "tests/reference/cli/program.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;
using test::contactcheck_program;
using test::Outcome;
using test::text_of;
using testing::HasSubstr;

TEST(ReportCommand, WritesTheRunsOwnReportAgain) {
  const test::Scratch scratch;
  const fs::path scene = scratch.write("tiny.json", test::tiny_scene());
  const fs::path out = scratch.folder() / "out", again = scratch.folder() / "deep" / "again";
  ASSERT_EQ(contactcheck_program({"run", scene, "--quiet", "--no-timing", "--out", out}).exit_code,
            0);
  const Outcome outcome = contactcheck_program({"report", out / "results.json", "--out", again});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr((again / "report.md").string()));
  EXPECT_NE(text_of(out / "report.md"), "");
  EXPECT_EQ(text_of(again / "report.md"), text_of(out / "report.md"));
  EXPECT_EQ(fs::exists(again / "report.html"), has_html_report());
  EXPECT_EQ(text_of(again / "report.html"), text_of(out / "report.html"));
}

TEST(ReportCommand, WritesTheFormatsAskedFor) {
  const test::Scratch scratch;
  const fs::path scene = scratch.write("tiny.json", test::tiny_scene());
  const fs::path out = scratch.folder() / "out", again = scratch.folder() / "again";
  ASSERT_EQ(contactcheck_program({"run", scene, "--quiet", "--no-timing", "--out", out}).exit_code,
            0);
  const fs::path results = out / "results.json";
  EXPECT_EQ(contactcheck_program({"report", results, "--format", "md", "--out", again}).exit_code,
            0);
  EXPECT_EQ(test::names_in(again), std::set<std::string>{"report.md"});
  const Outcome refused = contactcheck_program({"report", results, "--format", "pdf"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--format \"pdf\" is not known; allowed: html, md"));
}

TEST(ReportCommand, HtmlTakesTheReproductionOfTheSameRunAlone) {
  if (!has_html_report()) GTEST_SKIP() << "this program was built without the page";
  const test::Scratch scratch;
  const auto report = [&] {
    const Outcome outcome = contactcheck_program(
        {"report", CONTACTCHECK_EXAMPLE_RESULTS, "--format", "html", "--out", scratch.folder()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return text_of(scratch.folder() / "report.html");
  };
  const auto report_beside = [&](const std::string& reproduction) {
    const fs::path results = scratch.write("results.json", text_of(CONTACTCHECK_EXAMPLE_RESULTS));
    scratch.write("reproduction.json", reproduction);
    return contactcheck_program({"report", results, "--format", "html", "--out", scratch.folder()});
  };
  const std::string alone = report();
  EXPECT_EQ(report_beside(R"({"command": "contactcheck run other"})").exit_code, 0);
  EXPECT_EQ(text_of(scratch.folder() / "report.html"), alone);
  EXPECT_EQ(report_beside(R"({"command": "contactcheck run hello"})").exit_code, 0);
  EXPECT_NE(text_of(scratch.folder() / "report.html"), alone);
  const Outcome refused = report_beside("{");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("reproduction.json\" is no JSON object"));
}

}  // namespace
}  // namespace contactcheck
