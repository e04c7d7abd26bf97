#include "reference/diff/diff_text.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/reference/diff/tables.h"

namespace contactcheck {
namespace {

using test::perfect_row;
using test::table_of;
using testing::HasSubstr;

std::string text_of(const ResultTable& before, const ResultTable& after) {
  return diff_text(diff_results(before, after));
}

TEST(DiffText, OfEqualResultsIsOneLine) {
  const ResultTable table = table_of({perfect_row("s", "d"), perfect_row("s", "e")});
  EXPECT_EQ(text_of(table, table),
            "2 of 2 common rows have the same answers; 0 differ clearly in time.\n");
}

TEST(DiffText, HasASectionForEveryKindOfDifference) {
  ResultTable before = table_of({perfect_row("s", "worse"), perfect_row("s", "better"),
                                 perfect_row("s", "hash"), perfect_row("s", "gone"),
                                 perfect_row("old", "worse"), perfect_row("old", "better")});
  before.rows[1].levels["triangle"].spurious = 3;
  before.rows[2].speedups = {{"fcl-aabb", {2.0, 2.0, 2.0}}};
  before.truth_hashes = {{"s", "0x1"}, {"moved", "0x1"}};
  ResultTable after = before;
  after.rows.resize(3);
  after.machine[0].second = "B";
  after.truth_hashes["moved"] = "0x2";
  after.rows[0].levels["triangle"].missed = 1;
  after.rows[1].levels["triangle"].spurious = 0;
  after.rows[2].contact_hash = "0x2";
  after.rows[2].speedups = {{"fcl-aabb", {1.0, 1.0, 1.0}}};
  after.rows.push_back(perfect_row("s", "new"));
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
            "  s  hash  2.00x slower [2.00, 2.00], measured against fcl-aabb\n"
            "New (1)\n"
            "  detector new (in 1 scene)\n"
            "Gone (2)\n"
            "  scene old (2 detectors)\n"
            "  detector gone (in 1 scene)\n"
            "0 of 3 common rows have the same answers; 1 differ clearly in time.\n");
}

TEST(DiffText, FitsOnAScreenAndSaysWhatItLeavesOut) {
  ResultTable before, after;
  for (int i = 0; i < 300; ++i) {
    ResultRow row = perfect_row("s", "d" + std::to_string(i));
    row.speedups = {{"fcl-aabb", {1.0, 1.0, 1.0}}};
    before.rows.push_back(row);
    if (i % 3 == 0) row.levels["triangle"].missed = 1;
    if (i % 3 == 1) row.contact_hash = "0x2";
    row.speedups = {{"fcl-aabb", {i % 2 + 0.5, i % 2 + 0.5, i % 2 + 0.5}}};
    after.rows.push_back(row);
    before.rows.push_back(perfect_row("s", "gone" + std::to_string(i)));
    after.rows.push_back(perfect_row("new" + std::to_string(i), "d"));
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
}  // namespace contactcheck
