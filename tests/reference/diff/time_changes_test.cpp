#include "reference/diff/time_changes.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/reference/diff/tables.h"

namespace contactcheck {
namespace {

using test::perfect_row;
using test::table_of;
using testing::IsEmpty;

ResultRow fast(const std::string& detector, const RatioRow& over_fcl) {
  ResultRow row = perfect_row("s", detector);
  row.speedups = {{"fcl-aabb", over_fcl}};
  return row;
}

std::vector<TimeChange> changes(const RatioRow& then, const RatioRow& now) {
  return time_changes(table_of({fast("d", then)}), table_of({fast("d", now)}));
}

TEST(Quotient, CombinesTheIntervalsAsIndependentErrors) {
  // Of exp(3) and exp(4) to either side: sqrt(9 + 16) = 5 in the log domain.
  const RatioRow now = {2.0, 2.0 * std::exp(-3.0), 2.0 * std::exp(3.0)},
                 then = {4.0, 4.0 * std::exp(-4.0), 4.0 * std::exp(4.0)};
  const RatioRow factor = quotient(now, then);
  EXPECT_DOUBLE_EQ(factor.ratio, 0.5);
  EXPECT_NEAR(factor.low, 0.5 * std::exp(-5.0), 1e-12);
  EXPECT_NEAR(factor.high, 0.5 * std::exp(5.0), 1e-9);
}

TEST(Quotient, LowerEndComesFromTheLowEndNowAndTheHighEndThen) {
  const RatioRow factor = quotient({1.0, 0.5, 1.0}, {1.0, 1.0, 1.0});
  EXPECT_DOUBLE_EQ(factor.low, 0.5);
  EXPECT_DOUBLE_EQ(factor.high, 1.0);
  EXPECT_DOUBLE_EQ(quotient({1.0, 1.0, 1.0}, {1.0, 1.0, 2.0}).low, 0.5);
}

TEST(TimeChanges, LostSpeedUpIsAChange) {
  const auto found = changes({4.0, 3.9, 4.1}, {3.0, 2.9, 3.1});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].reference, "fcl-aabb");
  EXPECT_DOUBLE_EQ(found[0].factor.ratio, 0.75);
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
