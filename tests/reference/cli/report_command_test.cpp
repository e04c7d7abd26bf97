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

// What the page holds for its 3D view, packed.
std::string view_in(const fs::path& page) {
  const std::string text = text_of(page), before = R"(id="contactcheck-view" type="text/plain">)";
  const std::size_t at = text.find(before);
  if (at == std::string::npos) return "";
  return text.substr(at + before.size(), text.find('<', at) - at - before.size());
}

TEST(ReportCommand, ShowsTheRecordingsBesideTheResults) {
  if (!has_html_report()) GTEST_SKIP() << "built without npm";
  const test::Scratch scratch;
  const fs::path scene = scratch.write("tiny.json", test::tiny_scene());
  const fs::path out = scratch.folder() / "out", again = scratch.folder() / "again";
  ASSERT_EQ(contactcheck_program({"run", scene, "--quiet", "--no-timing", "--out", out}).exit_code,
            0);
  const std::string view = view_in(out / "report.html");
  EXPECT_GT(view.size(), 1000u);
  // A scene without its recording is named in the view and not drawn; the report is written.
  fs::remove_all(out / "recordings");
  EXPECT_EQ(contactcheck_program({"report", out / "results.json", "--out", again}).exit_code, 0);
  EXPECT_LT(view_in(again / "report.html").size(), view.size() / 2);
  EXPECT_NE(view_in(again / "report.html"), "");
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

}  // namespace
}  // namespace contactcheck
