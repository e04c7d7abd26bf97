#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
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
  EXPECT_THAT(refused.err, HasSubstr("--format \"pdf\" is not known; allowed: csv, html, md"));
}

// Python's reader, which knows nothing of this program, gets back what results.json holds.
constexpr const char* kReader = R"(
import csv, json, sys
results = json.load(open(sys.argv[1], encoding="utf-8"))
with open(sys.argv[2], newline="", encoding="utf-8") as file:
    rows = list(csv.DictReader(file, strict=True))
assert len(rows) == len(results["runs"]) > 3, len(rows)
for row, run in zip(rows, results["runs"]):
    assert None not in row and None not in row.values(), row
    for key in ("scene", "detector", "status", "message"):
        assert row[key] == run[key], (row[key], run[key])
    for level, counts in run.get("levels", {}).items():
        for key in ("truth", "reported", "hit", "missed", "spurious"):
            assert int(row[level + "_" + key]) == counts[key], (level, key)
        assert row[level + "_recall"] == ("" if counts["recall"] is None else repr(counts["recall"]))
    assert row["contact_hash"] == run.get("contact_hash", "")
    if "cold" in run.get("time_ms", {}):
        assert float(row["cold_frame_ms"]) == run["time_ms"]["cold"]["frame"]
    for reference, ratios in run.get("speedup", {}).get(row["speedup_question"], {}).items():
        for key in ("ratio", "low", "high"):
            assert float(row[f"vs_{reference}_cold_{key}"]) == ratios["cold"][key]
print("same")
)";

TEST(ReportCommand, CsvIsWhatPythonReadsBack) {
  const test::Scratch scratch;
  const fs::path scene = scratch.write("tiny.json", test::tiny_scene());
  const fs::path out = scratch.folder() / "out", file = out / "results.json";
  ASSERT_EQ(contactcheck_program({"run", scene, "--quiet", "--repeat", "2", "--out", out,
                                  "--detector", "fcl-aabb", "--detector", "ffd-lazy", "--detector",
                                  "ffd-grid", "--detector", "fcl-obbrss"})
                .exit_code,
            0);
  auto results = nlohmann::ordered_json::parse(text_of(file));
  results["runs"][0]["message"] = "said \"no\", and\r\nthen \u00e4 \n";
  scratch.write("out/results.json", results.dump());
  const Outcome report = contactcheck_program({"report", file, "--format", "csv,md", "--out", out});
  EXPECT_EQ(report.exit_code, 0) << report.err;
  const Outcome read =
      test::run_program(CONTACTCHECK_PYTHON, {"-c", kReader, file, out / "report.csv"});
  EXPECT_EQ(read.out, "same\n") << read.err;
}

}  // namespace
}  // namespace contactcheck
