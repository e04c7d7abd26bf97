#include "reference/results/results_diff.h"

#include <gmock/gmock.h>

#include "tests/reference/results/hand_results.h"

namespace contactcheck::results {
namespace {

using test::perfect_run;
using test::results_of;
using test::speedup_of;
using testing::IsEmpty;

results::Run fast(const std::string& detector, const Ratio& over_fcl) {
  results::Run row = perfect_run("s", detector);
  row.speedup[Question::kTriangles]["fcl-aabb"] = speedup_of(over_fcl);
  return row;
}

std::vector<TimeChange> time_changes_between(const results::Results& before,
                                             const results::Results& after) {
  return time_changes(results::Index(before), after);
}

std::vector<TimeChange> changes(const Ratio& then, const Ratio& now) {
  return time_changes_between(results_of({fast("d", then)}), results_of({fast("d", now)}));
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

TEST(TimeChanges, OfFewPassesAreBeyondAFactorAlone) {
  const auto of_range = [](const Ratio& now) {
    results::Run after = fast("d", now);
    after.speedup[Question::kTriangles]["fcl-aabb"].passes = 3;
    return time_changes_between(results_of({fast("d", {1.0, 1.0, 1.0})}), results_of({after}));
  };
  EXPECT_THAT(of_range({1.6, 1.4, 1.9}), IsEmpty());
  EXPECT_THAT(of_range({0.7, 0.68, 0.72}), IsEmpty());
  ASSERT_EQ(of_range({1.7, 1.6, 1.8}).size(), 1u);
  EXPECT_EQ(of_range({1.7, 1.6, 1.8})[0].passes, 3u);
  EXPECT_EQ(of_range({0.5, 0.4, 0.6}).size(), 1u);
}

TEST(TimeChanges, DetectorIsNotComparedWithItself) {
  const results::Results table = results_of({fast("fcl-aabb", {1.0, 1.0, 1.0})});
  EXPECT_THAT(time_changes_between(table, table), IsEmpty());
}

TEST(TimeChanges, WithoutACommonReferenceThereIsNothingToCompare) {
  results::Run other = fast("d", {4.0, 4.0, 4.0});
  other.speedup[Question::kTriangles] = {{"embree", speedup_of({4.0, 4.0, 4.0})}};
  EXPECT_THAT(time_changes_between(results_of({fast("d", {1.0, 1.0, 1.0})}), results_of({other})),
              IsEmpty());
}

TEST(TimeChanges, LargestComesFirstWhicheverWayItGoes) {
  const auto found = time_changes_between(
      results_of({fast("slower", {4.0, 4.0, 4.0}), fast("faster", {1.0, 1.0, 1.0})}),
      results_of({fast("slower", {2.0, 2.0, 2.0}), fast("faster", {3.0, 3.0, 3.0})}));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].detector, "faster");
}

}  // namespace
}  // namespace contactcheck::results
