#include "reference/diff/accuracy_changes.h"

#include <gmock/gmock.h>

#include "tests/reference/diff/tables.h"

namespace contactcheck {
namespace {

using test::perfect_row;
using test::table_of;
using testing::ElementsAre;
using testing::IsEmpty;

// The only change from a perfect row to `after`.
RowChange change_to(const ResultRow& after) {
  const auto changes = accuracy_changes(table_of({perfect_row("s", "d")}), table_of({after}));
  EXPECT_EQ(changes.size(), 1u);
  return changes.empty() ? RowChange{} : changes.front();
}

RowChange change_from(const ResultRow& before) {
  return accuracy_changes(table_of({before}), table_of({perfect_row("s", "d")})).at(0);
}

TEST(AccuracyChanges, EqualRowsHaveNone) {
  const ResultTable table = table_of({perfect_row("s", "d"), perfect_row("s", "e")});
  EXPECT_THAT(accuracy_changes(table, table), IsEmpty());
}

TEST(AccuracyChanges, OneMissedContactIsWorseAndOneLessIsBetter) {
  ResultRow row = perfect_row("s", "d");
  row.levels["triangle"].missed = 1;
  EXPECT_EQ(change_to(row).direction, Direction::kWorse);
  EXPECT_THAT(change_to(row).what, ElementsAre("triangle missed 0 -> 1"));
  EXPECT_EQ(change_from(row).direction, Direction::kBetter);
  EXPECT_THAT(change_from(row).what, ElementsAre("triangle missed 1 -> 0"));
}

TEST(AccuracyChanges, OneSpuriousContactIsWorse) {
  ResultRow row = perfect_row("s", "d");
  row.levels["triangle"].spurious = 1;
  EXPECT_EQ(change_to(row).direction, Direction::kWorse);
  EXPECT_THAT(change_to(row).what, ElementsAre("triangle spurious 0 -> 1"));
}

TEST(AccuracyChanges, WorseAnywhereIsWorse) {
  ResultRow before = perfect_row("s", "d"), after = before;
  before.levels["triangle"].spurious = 5;
  after.levels["triangle"].missed = 1;
  const auto changes = accuracy_changes(table_of({before}), table_of({after}));
  EXPECT_EQ(changes.at(0).direction, Direction::kWorse);
}

TEST(AccuracyChanges, WhatIsNotClaimedIsNamedAndNotHeldAgainstADetector) {
  ResultRow before = perfect_row("s", "d");
  before.levels["vertex"] = {4, 0, 0, true};
  ResultRow after = before;
  after.levels["vertex"].missed = 4;
  const auto changes = accuracy_changes(table_of({before}), table_of({after}));
  EXPECT_EQ(changes.at(0).direction, Direction::kOther);
  EXPECT_THAT(changes.at(0).what, ElementsAre("vertex (informative) missed 0 -> 4"));
}

TEST(AccuracyChanges, OtherContactsInTheSameNumberAreNeitherBetterNorWorse) {
  ResultRow row = perfect_row("s", "d");
  row.contact_hash = "0x2";
  EXPECT_EQ(change_to(row).direction, Direction::kOther);
  EXPECT_THAT(change_to(row).what, ElementsAre("contact hash 0x1 -> 0x2"));
}

TEST(AccuracyChanges, GeometryCountsByTheSizeOfItsError) {
  ResultRow row = perfect_row("s", "d");
  row.geometry["covered_length_fraction"] = 0.5;
  EXPECT_EQ(change_to(row).direction, Direction::kWorse);
  EXPECT_THAT(change_to(row).what, ElementsAre("covered_length_fraction 1 -> 0.5"));
  EXPECT_EQ(change_from(row).direction, Direction::kBetter);
  row = perfect_row("s", "d");
  row.geometry["late_frames"] = -2.0;
  EXPECT_EQ(change_to(row).direction, Direction::kWorse) << "too early is an error, too";
}

TEST(AccuracyChanges, AsManyFramesEarlyAsLateIsNeitherBetterNorWorse) {
  ResultRow early = perfect_row("s", "d"), late = early;
  early.geometry["late_frames"] = -2.0;
  late.geometry["late_frames"] = 2.0;
  const RowChange later = accuracy_changes(table_of({early}), table_of({late})).at(0);
  EXPECT_EQ(later.direction, Direction::kOther);
  EXPECT_THAT(later.what, ElementsAre("late_frames -2 -> 2"));
  EXPECT_EQ(accuracy_changes(table_of({late}), table_of({early})).at(0).direction,
            Direction::kOther);
  late.geometry["late_frames"] = 1.0;
  EXPECT_EQ(accuracy_changes(table_of({early}), table_of({late})).at(0).direction,
            Direction::kBetter);
}

TEST(AccuracyChanges, ErrorThatIsMeasuredForTheFirstTimeIsNeither) {
  ResultRow row = perfect_row("s", "d");
  row.geometry["missed_length"].reset();
  EXPECT_EQ(change_to(row).direction, Direction::kOther);
  EXPECT_THAT(change_to(row).what, ElementsAre("missed_length 0 -> none"));
}

TEST(AccuracyChanges, StatusStandsForTheWholeRow) {
  ResultRow row;
  row.scene = "s";
  row.detector = "d";
  row.status = "error";
  row.message = "signal 11";
  EXPECT_EQ(change_to(row).direction, Direction::kWorse);
  EXPECT_THAT(change_to(row).what, ElementsAre("ok -> error: signal 11"));
  EXPECT_EQ(change_from(row).direction, Direction::kBetter);
  ResultRow absent = row;
  absent.status = "absent";
  EXPECT_EQ(accuracy_changes(table_of({absent}), table_of({row})).at(0).direction,
            Direction::kWorse);
}

TEST(AccuracyChanges, LevelThatIsNoLongerJudgedIsNamed) {
  ResultRow row = perfect_row("s", "d");
  row.levels["body"] = {1, 0, 0, false};
  EXPECT_THAT(change_to(row).what, ElementsAre("level body is judged only after"));
  EXPECT_THAT(change_from(row).what, ElementsAre("level body is judged only before"));
}

TEST(AccuracyChanges, OfAnotherTruthAreNeitherBetterNorWorse) {
  ResultTable before = table_of({perfect_row("s", "d")}), after = before;
  after.rows[0].levels["triangle"] = {20, 2, 0, false};
  before.truth_hashes = after.truth_hashes = {{"s", "0x1"}};
  EXPECT_EQ(accuracy_changes(before, after).at(0).direction, Direction::kWorse);
  after.truth_hashes["s"] = "0x2";
  EXPECT_EQ(accuracy_changes(before, after).at(0).direction, Direction::kOther);
  EXPECT_THAT(accuracy_changes(before, after).at(0).what,
              ElementsAre("triangle truth 10 -> 20", "triangle missed 0 -> 2"));
  after.rows[0].status = "error";
  EXPECT_EQ(accuracy_changes(before, after).at(0).direction, Direction::kWorse);
}

TEST(AccuracyChanges, MostImportantComesFirst) {
  ResultTable before =
      table_of({perfect_row("s", "hash"), perfect_row("s", "one"), perfect_row("s", "many"),
                perfect_row("s", "dead"), perfect_row("s", "gone")});
  ResultTable after = before;
  after.rows.pop_back();
  after.rows[0].contact_hash = "0x2";
  after.rows[1].levels["triangle"].missed = 1;
  after.rows[2].levels["triangle"].missed = 9;
  after.rows[3].status = "error";
  std::vector<std::string> order;
  for (const RowChange& change : accuracy_changes(before, after)) order.push_back(change.detector);
  EXPECT_THAT(order, ElementsAre("dead", "many", "one", "hash"));
}

}  // namespace
}  // namespace contactcheck
