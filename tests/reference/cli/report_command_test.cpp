#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <set>

#include "reference/report/html.h"
#include "tests/reference/cli/program.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
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
  EXPECT_EQ(fs::exists(again / "report.html"), report::has_html_report());
  EXPECT_EQ(text_of(again / "report.html"), text_of(out / "report.html"));
}

TEST(ReportCommand, DrawsThePicturesOfTheRun) {
  const test::Scratch scratch;
  const fs::path scene = scratch.write("tiny.json", test::tiny_scene());
  const fs::path out = scratch.folder() / "out", again = scratch.folder() / "again";
  ASSERT_EQ(contactcheck_program({"run", scene, "--detector", "ffd-grid", "--detector", "ffd-aabb",
                                  "--quiet", "--processes", "1", "--out", out})
                .exit_code,
            0);
  ASSERT_EQ(contactcheck_program({"report", out / "results.json", "--format", "md", "--out", again})
                .exit_code,
            0);
  EXPECT_EQ(test::names_in(again / "plots"), test::names_in(out / "plots"));
  for (const char* name : {"speed_error.svg", "who_errs.svg"}) {
    const fs::path picture = fs::path("plots") / name;
    EXPECT_THAT(text_of(out / picture), HasSubstr("ffd-grid"));
    EXPECT_EQ(text_of(again / picture), text_of(out / picture));
    const Outcome xml = test::run_program(CONTACTCHECK_PYTHON3,
                                          {"-c",
                                           "import sys, xml.dom.minidom as dom\n"
                                           "print(dom.parse(sys.argv[1]).documentElement.tagName)",
                                           (out / picture).string()});
    EXPECT_EQ(xml.out, "svg\n") << xml.err;
  }
}

// What the page holds for its 3D view, packed.
std::string view_in(const fs::path& page) {
  const std::string text = text_of(page), before = R"(id="contactcheck-view" type="text/plain">)";
  const std::size_t at = text.find(before);
  if (at == std::string::npos) return "";
  return text.substr(at + before.size(), text.find('<', at) - at - before.size());
}

TEST(ReportCommand, ShowsTheRecordingsBesideTheResults) {
  if (!report::has_html_report()) GTEST_SKIP() << "install nodejs and npm, and build anew";
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
  EXPECT_EQ(test::names_in(again), (std::set<std::string>{"plots", "report.md"}));
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
    for times in [run.get("time_ms", {}), *run.get("time_ms_other_questions", [])]:
        if times.get("question") == row["question"] != "":
            for regime in {"playback", "cold"} & set(times):
                assert float(row[regime + "_frame_ms"]) == times[regime]["frame"]
    for reference, ratios in run.get("speedup", {}).get(row["question"], {}).items():
        for key in ("ratio", "low", "high"):
            assert float(row[f"vs_{reference}_playback_{key}"]) == ratios["playback"][key]
print("same")
)";

TEST(ReportCommand, CsvIsWhatPythonReadsBack) {
  const test::Scratch scratch;
  const fs::path scene = scratch.write("tiny.json", test::tiny_scene());
  const fs::path out = scratch.folder() / "out", file = out / "results.json";
  ASSERT_EQ(contactcheck_program({"run", scene, "--quiet", "--processes", "1", "--out", out,
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
      test::run_program(CONTACTCHECK_PYTHON3, {"-c", kReader, file, out / "report.csv"});
  EXPECT_EQ(read.out, "same\n") << read.err;
}

TEST(ReportCommand, HtmlTakesTheReproductionOfTheSameRunAlone) {
  if (!report::has_html_report()) GTEST_SKIP() << "install nodejs and npm, and build anew";
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
  EXPECT_EQ(report_beside(R"({"command": "contactcheck run hello", "scenes": [], "means": null,
      "paper": {"source": {"authors": [], "title": "", "journal": "", "year": 1, "doi": ""},
                "findings": []}})")
                .exit_code,
            0);
  EXPECT_NE(text_of(scratch.folder() / "report.html"), alone);
  const Outcome refused = report_beside("{");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("reproduction.json\" is no JSON object"));
  const Outcome older = report_beside(R"({"command": "contactcheck run hello", "scenes": [{}]})");
  EXPECT_EQ(older.exit_code, 2);
  EXPECT_THAT(older.err, HasSubstr("reproduction.json\" is no reproduction as this version"));
  const Outcome deep = report_beside(R"({"command": "contactcheck run hello", "scenes": )" +
                                     std::string(100'000, '[') + std::string(100'000, ']') + "}");
  EXPECT_EQ(deep.exit_code, 2);
  EXPECT_THAT(deep.err, HasSubstr("reproduction.json: nested 100001 deep"));
}

}  // namespace
}  // namespace contactcheck::cli
