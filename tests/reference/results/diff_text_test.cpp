#include "reference/results/results_diff.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/reference/results/hand_results.h"

namespace contactcheck::results {
namespace {

using test::perfect_run;
using test::results_of;
using test::speedup_of;
using testing::HasSubstr;

std::string text_of(const results::Results& before, const results::Results& after) {
  return diff_text(diff_results(before, after));
}

TEST(DiffText, OfEqualResultsIsOneLine) {
  const results::Results table = results_of({perfect_run("s", "d"), perfect_run("s", "e")});
  EXPECT_EQ(text_of(table, table),
            "2 of 2 common rows have the same answers; 0 differ clearly in time.\n");
}

TEST(DiffText, HasASectionForEveryKindOfDifference) {
  results::Results before = results_of({perfect_run("s", "worse"), perfect_run("s", "better"),
                                        perfect_run("s", "hash"), perfect_run("s", "gone"),
                                        perfect_run("old", "worse"), perfect_run("old", "better")});
  before.runs[1].levels[Level::kTriangle].spurious = 3;
  before.runs[2].speedup[Question::kTriangles]["fcl-aabb"] = speedup_of({2.0, 2.0, 2.0});
  before.scenes = {test::scene_of("s", "0x1"), test::scene_of("moved", "0x1")};
  results::Results after = before;
  after.runs.resize(3);
  after.machine.cpu = "B";
  after.scenes[1].truth_hash = "0x2";
  after.runs[0].levels[Level::kTriangle].missed = 1;
  after.runs[1].levels[Level::kTriangle].spurious = 0;
  after.runs[2].contact_hash = "0x2";
  after.runs[2].speedup[Question::kTriangles]["fcl-aabb"] = speedup_of({1.0, 1.0, 1.0});
  after.runs.push_back(perfect_run("s", "new"));
  EXPECT_EQ(text_of(before, after),
            "Another machine: times compare ratios, but caches and instructions differ (1)\n"
            "  cpu \"A\" -> \"B\"\n"
            "Another scene of the same name: its exact truth differs (1)\n"
            "  moved\n"
            "Worse (1)\n"
            "  s  worse  triangle missed 0 -> 1\n"
            "Better (1)\n"
            "  s  better  triangle spurious 3 -> 0\n"
            "Other answers, neither better nor worse (1)\n"
            "  s  hash  contact hash 0x1 -> 0x2\n"
            "Slower (1)\n"
            "  s  hash  2.00x [2.00, 2.00] slower, measured against fcl-aabb\n"
            "New (1)\n"
            "  detector new (in 1 scene)\n"
            "Gone (2)\n"
            "  scene old (2 detectors)\n"
            "  detector gone (in 1 scene)\n"
            "0 of 3 common rows have the same answers; 1 differ clearly in time.\n");
}

TEST(DiffText, SaysWhatTheEndsOfARatioAre) {
  const auto line = [](std::size_t passes, const Ratio& now) {
    results::Results before = results_of({perfect_run("s", "d")}), after = before;
    before.runs[0].speedup[Question::kTriangles]["fcl-aabb"] = speedup_of({1.0, 1.0, 1.0});
    after.runs[0].speedup[Question::kTriangles]["fcl-aabb"] = speedup_of(now);
    after.runs[0].speedup[Question::kTriangles]["fcl-aabb"].passes = passes;
    return text_of(before, after);
  };
  EXPECT_THAT(line(5, {3.0, 2.0, 4.5}), HasSubstr("3.00x [2.00, 4.50] faster, measured"));
  EXPECT_THAT(line(3, {3.0, 2.0, 4.5}), HasSubstr("3.00x (range 2.00 to 4.50) faster, measured"));
  EXPECT_THAT(line(1, {3.0, 3.0, 3.0}), HasSubstr("3.00x (1 pass) faster, measured"));
}

TEST(DiffText, FitsOnAScreenAndSaysWhatItLeavesOut) {
  results::Results before, after;
  for (int i = 0; i < 300; ++i) {
    results::Run row = perfect_run("s", "d" + std::to_string(i));
    row.speedup[Question::kTriangles]["fcl-aabb"] = speedup_of({1.0, 1.0, 1.0});
    before.runs.push_back(row);
    if (i % 3 == 0) row.levels[Level::kTriangle].missed = 1;
    if (i % 3 == 1) row.contact_hash = "0x2";
    row.speedup[Question::kTriangles]["fcl-aabb"] =
        speedup_of({i % 2 + 0.5, i % 2 + 0.5, i % 2 + 0.5});
    after.runs.push_back(row);
    before.runs.push_back(perfect_run("s", "gone" + std::to_string(i)));
    after.runs.push_back(perfect_run("new" + std::to_string(i), "d"));
  }
  const std::string text = text_of(before, after);
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 45);
  EXPECT_THAT(text, HasSubstr("Worse (100)\n"));
  EXPECT_THAT(text, HasSubstr("  ... and 95 more\n"));
  EXPECT_THAT(text, HasSubstr("100 of 300 common rows have the same answers"));
}

TEST(DiffText, LineOfARowNamesThreeDifferencesAndCountsTheRest) {
  RowChange change;
  change.scene = "s";
  change.detector = "d";
  change.what = {"a", "b", "c", "d", "e"};
  EXPECT_EQ(change_line(change), "s  d  a, b, c, and 2 more");
}

}  // namespace
}  // namespace contactcheck::results
