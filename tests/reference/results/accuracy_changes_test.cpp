#include "reference/results/accuracy_changes.h"

#include <gmock/gmock.h>

#include "tests/reference/results/hand_results.h"

namespace contactcheck::results {
namespace {

using test::perfect_run;
using test::results_of;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<RowChange> changes_between(const results::Results& before,
                                       const results::Results& after) {
  return accuracy_changes(results::Index(before), results::Index(after));
}

// The only change from a perfect row to `after`.
RowChange change_to(const results::Run& after) {
  const auto changes = changes_between(results_of({perfect_run("s", "d")}), results_of({after}));
  EXPECT_EQ(changes.size(), 1u);
  return changes.empty() ? RowChange{} : changes.front();
}

RowChange change_from(const results::Run& before) {
  return changes_between(results_of({before}), results_of({perfect_run("s", "d")})).at(0);
}

TEST(AccuracyChanges, EqualRowsHaveNone) {
  const results::Results table = results_of({perfect_run("s", "d"), perfect_run("s", "e")});
  EXPECT_THAT(changes_between(table, table), IsEmpty());
}

TEST(AccuracyChanges, OneMissedContactIsWorseAndOneLessIsBetter) {
  results::Run row = perfect_run("s", "d");
  row.levels[Level::kTriangle].missed = 1;
  EXPECT_EQ(change_to(row).direction, Direction::kWorse);
  EXPECT_THAT(change_to(row).what, ElementsAre("triangle missed 0 -> 1"));
  EXPECT_EQ(change_from(row).direction, Direction::kBetter);
  EXPECT_THAT(change_from(row).what, ElementsAre("triangle missed 1 -> 0"));
}

TEST(AccuracyChanges, OneSpuriousContactIsWorse) {
  results::Run row = perfect_run("s", "d");
  row.levels[Level::kTriangle].spurious = 1;
  EXPECT_EQ(change_to(row).direction, Direction::kWorse);
  EXPECT_THAT(change_to(row).what, ElementsAre("triangle spurious 0 -> 1"));
}

TEST(AccuracyChanges, WorseAnywhereIsWorse) {
  results::Run before = perfect_run("s", "d"), after = before;
  before.levels[Level::kTriangle].spurious = 5;
  after.levels[Level::kTriangle].missed = 1;
  const auto changes = changes_between(results_of({before}), results_of({after}));
  EXPECT_EQ(changes.at(0).direction, Direction::kWorse);
  EXPECT_THAT(changes.at(0).what, ElementsAre("triangle missed 0 -> 1", "triangle spurious 5 -> 0",
                                              "mixed: better in some of these"));
}

TEST(AccuracyChanges, WhatIsNotClaimedIsNamedAndNotHeldAgainstADetector) {
  results::Run before = perfect_run("s", "d");
  before.levels[Level::kVertex].truth = 4;
  before.levels[Level::kVertex].informative = true;
  results::Run after = before;
  after.levels[Level::kVertex].missed = 4;
  const auto changes = changes_between(results_of({before}), results_of({after}));
  EXPECT_EQ(changes.at(0).direction, Direction::kOther);
  EXPECT_THAT(changes.at(0).what, ElementsAre("vertex (informative) missed 0 -> 4"));
}

TEST(AccuracyChanges, OtherContactsInTheSameNumberAreNeitherBetterNorWorse) {
  results::Run row = perfect_run("s", "d");
  row.contact_hash = "0x2";
  EXPECT_EQ(change_to(row).direction, Direction::kOther);
  EXPECT_THAT(change_to(row).what, ElementsAre("contact hash 0x1 -> 0x2"));
}

TEST(AccuracyChanges, GeometryCountsByTheSizeOfItsError) {
  results::Run row = perfect_run("s", "d");
  row.geometry.covered_length_fraction = 0.5;
  EXPECT_EQ(change_to(row).direction, Direction::kWorse);
  EXPECT_THAT(change_to(row).what, ElementsAre("covered_length_fraction 1 -> 0.5"));
  EXPECT_EQ(change_from(row).direction, Direction::kBetter);
  row = perfect_run("s", "d");
  row.geometry.late_frames = -2;
  EXPECT_EQ(change_to(row).direction, Direction::kWorse) << "too early is an error, too";
}

TEST(AccuracyChanges, AsManyFramesEarlyAsLateIsNeitherBetterNorWorse) {
  results::Run early = perfect_run("s", "d"), late = early;
  early.geometry.late_frames = -2;
  late.geometry.late_frames = 2;
  const RowChange later = changes_between(results_of({early}), results_of({late})).at(0);
  EXPECT_EQ(later.direction, Direction::kOther);
  EXPECT_THAT(later.what, ElementsAre("late_frames -2 -> 2"));
  EXPECT_EQ(changes_between(results_of({late}), results_of({early})).at(0).direction,
            Direction::kOther);
  late.geometry.late_frames = 1;
  EXPECT_EQ(changes_between(results_of({early}), results_of({late})).at(0).direction,
            Direction::kBetter);
}

TEST(AccuracyChanges, ErrorThatIsMeasuredForTheFirstTimeIsNeither) {
  results::Run row = perfect_run("s", "d");
  row.geometry.missed_length.reset();
  EXPECT_EQ(change_to(row).direction, Direction::kOther);
  EXPECT_THAT(change_to(row).what, ElementsAre("missed_length 0 -> none"));
}

TEST(AccuracyChanges, StatusStandsForTheWholeRow) {
  results::Run row;
  row.scene = "s";
  row.detector = "d";
  row.status = results::Status::kError;
  row.message = "signal 11";
  EXPECT_EQ(change_to(row).direction, Direction::kWorse);
  EXPECT_THAT(change_to(row).what, ElementsAre("ok -> error: signal 11"));
  EXPECT_EQ(change_from(row).direction, Direction::kBetter);
  results::Run absent = row;
  absent.status = results::Status::kAbsent;
  EXPECT_EQ(changes_between(results_of({absent}), results_of({row})).at(0).direction,
            Direction::kWorse);
}

TEST(AccuracyChanges, LevelThatIsNoLongerJudgedIsNamed) {
  results::Run row = perfect_run("s", "d");
  row.levels[Level::kBody].truth = 1;
  EXPECT_THAT(change_to(row).what, ElementsAre("level body is judged only after"));
  EXPECT_THAT(change_from(row).what, ElementsAre("level body is judged only before"));
}

TEST(AccuracyChanges, OfAnotherTruthAreNeitherBetterNorWorse) {
  results::Results before = results_of({perfect_run("s", "d")}), after = before;
  after.runs[0].levels[Level::kTriangle].truth = 20;
  after.runs[0].levels[Level::kTriangle].missed = 2;
  before.scenes = after.scenes = {test::scene_of("s", "0x1")};
  EXPECT_EQ(changes_between(before, after).at(0).direction, Direction::kWorse);
  after.scenes[0].truth_hash = "0x2";
  EXPECT_EQ(changes_between(before, after).at(0).direction, Direction::kOther);
  EXPECT_THAT(changes_between(before, after).at(0).what,
              ElementsAre("triangle truth 10 -> 20", "triangle missed 0 -> 2"));
  after.runs[0].status = results::Status::kError;
  EXPECT_EQ(changes_between(before, after).at(0).direction, Direction::kWorse);
}

TEST(AccuracyChanges, MostImportantComesFirst) {
  results::Results before =
      results_of({perfect_run("s", "hash"), perfect_run("s", "one"), perfect_run("s", "many"),
                  perfect_run("s", "dead"), perfect_run("s", "gone")});
  results::Results after = before;
  after.runs.pop_back();
  after.runs[0].contact_hash = "0x2";
  after.runs[1].levels[Level::kTriangle].missed = 1;
  after.runs[2].levels[Level::kTriangle].missed = 9;
  after.runs[3].status = results::Status::kError;
  std::vector<std::string> order;
  for (const RowChange& change : changes_between(before, after)) order.push_back(change.detector);
  EXPECT_THAT(order, ElementsAre("dead", "many", "one", "hash"));
}

TEST(AccuracyChanges, RoundedTruthIsALevelOfItsOwn) {
  results::Run run = perfect_run("s", "d");
  run.levels_rounded[Level::kTriangle].truth = 10;
  results::Run worse = run;
  worse.levels_rounded[Level::kTriangle].missed = 1;
  const auto changes = changes_between(results_of({run}), results_of({worse}));
  EXPECT_THAT(changes.at(0).what, ElementsAre("triangle rounded missed 0 -> 1"));
}

}  // namespace
}  // namespace contactcheck::results
