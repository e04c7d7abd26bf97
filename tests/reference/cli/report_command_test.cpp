#include <gmock/gmock.h>

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

TEST(ReportCommand, WritesTheRunsOwnReportAgain) {
  const test::Scratch scratch;
  const fs::path scene = scratch.write("tiny.json", test::tiny_scene());
  const fs::path out = scratch.folder() / "out", again = scratch.folder() / "deep" / "again";
  ASSERT_EQ(contactcheck_program({"run", scene, "--quiet", "--no-timing", "--out", out}).exit_code,
            0);
  const Outcome outcome = contactcheck_program({"report", out / "results.json", "--out", again});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, (again / "report.md").string() + "\n");
  EXPECT_NE(text_of(out / "report.md"), "");
  EXPECT_EQ(text_of(again / "report.md"), text_of(out / "report.md"));
}

}  // namespace
}  // namespace contactcheck
