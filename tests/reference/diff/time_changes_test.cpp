#include "reference/diff/time_changes.h"

#include <gmock/gmock.h>

#include "tests/reference/diff/tables.h"

namespace contactcheck {
namespace {

using test::perfect_row;
using test::table_of;
using testing::IsEmpty;

ResultRow fast(const std::string& detector, const Ratio& over_fcl) {
  ResultRow row = perfect_row("s", detector);
  row.speedups = {{"fcl-aabb", over_fcl}};
  return row;
}

std::vector<TimeChange> changes(const Ratio& then, const Ratio& now) {
  return time_changes(table_of({fast("d", then)}), table_of({fast("d", now)}));
}

TEST(TimeChanges, LostSpeedUpIsAChange) {
  const auto found = changes({4.0, 3.9, 4.1}, {3.0, 2.9, 3.1});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].reference, "fcl-aabb");
  EXPECT_DOUBLE_EQ(found[0].factor.value, 0.75);
  EXPECT_LT(found[0].factor.high, 1.0);
}

TEST(TimeChanges, IntervalThatHoldsOneIsNoChange) {
  EXPECT_THAT(changes({4.0, 2.5, 5.0}, {3.0, 2.9, 3.1}), IsEmpty());
}

TEST(TimeChanges, SmallOnesAreNotWorthALine) {
  EXPECT_THAT(changes({4.0, 4.0, 4.0}, {4.1, 4.1, 4.1}), IsEmpty());
  EXPECT_EQ(changes({4.0, 4.0, 4.0}, {4.3, 4.3, 4.3}).size(), 1u);
}

TEST(TimeChanges, DetectorIsNotComparedWithItself) {
  const ResultTable table = table_of({fast("fcl-aabb", {1.0, 1.0, 1.0})});
  EXPECT_THAT(time_changes(table, table), IsEmpty());
}

TEST(TimeChanges, WithoutACommonReferenceThereIsNothingToCompare) {
  ResultRow other = fast("d", {4.0, 4.0, 4.0});
  other.speedups.front().first = "embree";
  EXPECT_THAT(time_changes(table_of({fast("d", {1.0, 1.0, 1.0})}), table_of({other})), IsEmpty());
}

TEST(TimeChanges, LargestComesFirstWhicheverWayItGoes) {
  const auto found =
      time_changes(table_of({fast("slower", {4.0, 4.0, 4.0}), fast("faster", {1.0, 1.0, 1.0})}),
                   table_of({fast("slower", {2.0, 2.0, 2.0}), fast("faster", {3.0, 3.0, 3.0})}));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].detector, "faster");
}

}  // namespace
}  // namespace contactcheck
