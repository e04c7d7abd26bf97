#include "reference/results/defect_comparison.h"

#include <gmock/gmock.h>

namespace contactcheck::results {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using testing::SizeIs;

constexpr auto kMissed = SightingKind::kMissed;
constexpr auto kSpurious = SightingKind::kSpurious;
constexpr auto kError = SightingKind::kError;
const LibraryVersions kVersions = {{"fcl", "0.7.0"}};

Sighting at(const char* value, SightingKind kind = kMissed, const char* scene = "gap") {
  return {"fcl-aabb", scene, kind, value};
}

// Of 3 pairs each.
CountedSightings counted(const std::vector<Sighting>& seen) {
  CountedSightings out;
  for (const Sighting& s : seen) out[s] = 3;
  return out;
}

KnownDefects known_at(const std::vector<Sighting>& seen, const char* version = "0.7.0") {
  return {{{"fcl", version, "overlap()", {}, seen.front().kind, "why", counted(seen)}}};
}

SightingsOfRun run_with(const std::vector<Sighting>& seen, std::set<Sighting> unseen = {}) {
  SightingsOfRun run{counted(seen), std::move(unseen)};
  run.possible.insert(seen.begin(), seen.end());
  return run;
}

constexpr DefectComparison::Change kGone{3, 0}, kNew{0, 3};

std::string fcl(const std::string&) { return "fcl"; }

TEST(DefectComparison, IsSilentWhereAllIsAsListed) {
  const auto found =
      compare_defects(known_at({at("0"), at("1")}), run_with({at("0"), at("1")}), kVersions);
  EXPECT_THAT(found.not_shown, IsEmpty());
  EXPECT_THAT(found.unlisted, IsEmpty());
  EXPECT_EQ(found.counts.at(0).listed, 2u);
  EXPECT_EQ(found.counts.at(0).shown, 2u);
  EXPECT_EQ(found.counts.at(0).changed, 0u);
  EXPECT_TRUE(found.as_listed());
}

TEST(DefectComparison, NamesWhatShowsWithAnotherCount) {
  SightingsOfRun run = run_with({at("0"), at("1"), at("2")});
  run.seen[at("0")] = 1'000'000;
  run.seen[at("1")] = 1;
  const auto found = compare_defects(known_at({at("0"), at("1"), at("2")}), run, kVersions);
  EXPECT_THAT(found.changed, ElementsAre(Pair(at("0"), DefectComparison::Change{3, 1'000'000}),
                                         Pair(at("1"), DefectComparison::Change{3, 1})));
  EXPECT_THAT(found.not_shown, IsEmpty());
  EXPECT_THAT(found.unlisted, IsEmpty());
  EXPECT_EQ(found.counts.at(0).shown, 3u);
  EXPECT_EQ(found.counts.at(0).changed, 2u);
  EXPECT_FALSE(found.as_listed());
}

TEST(DefectComparison, NamesWhatIsListedAndDoesNotShow) {
  const auto found =
      compare_defects(known_at({at("0"), at("1")}), run_with({at("0")}, {at("1")}), kVersions);
  EXPECT_THAT(found.not_shown, ElementsAre(Pair(at("1"), kGone)));
  EXPECT_FALSE(found.as_listed());
  EXPECT_EQ(found.counts.at(0).shown, 1u);
}

TEST(DefectComparison, NamesWhatShowsAndIsNotListed) {
  const auto found =
      compare_defects(known_at({at("0")}), run_with({at("0"), at("0", kSpurious)}), kVersions);
  EXPECT_THAT(found.unlisted, ElementsAre(Pair(at("0", kSpurious), kNew)));
  EXPECT_FALSE(found.as_listed());
}

TEST(DefectComparison, SaysNothingOfCasesThatDidNotRun) {
  const auto found = compare_defects(known_at({at("0"), at("1")}), run_with({at("0")}), kVersions);
  EXPECT_THAT(found.not_shown, IsEmpty());
  EXPECT_EQ(found.counts.at(0).listed, 1u);
}

TEST(DefectComparison, HoldsNoOtherVersionToTheList) {
  const auto found = compare_defects(known_at({at("0"), at("1")}, "0.6.1"),
                                     run_with({at("0")}, {at("1")}), kVersions);
  EXPECT_TRUE(found.counts.at(0).other_version);
  EXPECT_THAT(found.not_shown, IsEmpty());
  EXPECT_THAT(found.unlisted, ElementsAre(Pair(at("0"), kNew)))
      << "of this version nothing is known";
}

TEST(DefectComparison, OnlyErrorsThatAreNotListedAreUnlistedErrors) {
  const SightingsOfRun run = run_with({at("0", kError)});
  EXPECT_TRUE(any_unlisted_error(compare_defects({}, run, kVersions)));
  EXPECT_FALSE(any_unlisted_error(compare_defects(known_at({at("0", kError)}), run, kVersions)));
  EXPECT_FALSE(any_unlisted_error(compare_defects({}, run_with({at("0")}), kVersions)));
}

TEST(DefectComparison, TakesOurOwnDetectorsForOfAnyVersion) {
  results::Results results;
  results.libraries = {{"fcl", "0.7.0"}};
  const LibraryVersions versions = versions_in(results);
  EXPECT_THAT(versions, testing::UnorderedElementsAre(testing::Pair("contactcheck", "any"),
                                                      testing::Pair("fcl", "0.7.0")));
}

TEST(DefectComparison, StandsInResults) {
  const KnownDefects known = known_at({at("0"), at("1"), at("2")});
  const DefectCounts found = in_results(
      known,
      compare_defects(known, run_with({at("3"), at("4"), at("5", kSpurious)}, {at("0"), at("1")}),
                      kVersions));
  ASSERT_THAT(found.defects, SizeIs(1));
  EXPECT_EQ(found.defects[0].listed, 2u);
  EXPECT_EQ(found.defects[0].shown, 0u);
  EXPECT_THAT(found.defects[0].detectors, ElementsAre("fcl-aabb"));
  EXPECT_THAT(found.readings, IsEmpty());
  ASSERT_THAT(found.not_shown, SizeIs(1));
  EXPECT_EQ(found.not_shown[0].detector, "fcl-aabb");
  EXPECT_EQ(found.not_shown[0].scene, "gap");
  EXPECT_EQ(found.not_shown[0].kind, "missed");
  EXPECT_THAT(found.not_shown[0].values, ElementsAre("0", "1"));
  EXPECT_THAT(found.not_shown[0].was, ElementsAre(3, 3));
  EXPECT_THAT(found.not_shown[0].is, IsEmpty());
  ASSERT_THAT(found.unlisted, SizeIs(2));
  EXPECT_THAT(found.unlisted[0].was, IsEmpty());
  EXPECT_THAT(found.unlisted[0].is, ElementsAre(3, 3));
}

TEST(DefectComparison, TellsReadingsFromDefectsInResults) {
  KnownDefects known = known_at({at("0")});
  known.defects.push_back(known.defects.front());
  known.defects.back().library = kOwnLibrary;
  known.defects.back().version = kOwnVersion;
  const LibraryVersions versions = {{"fcl", "0.7.0"}, {kOwnLibrary, kOwnVersion}};
  SightingsOfRun run = run_with({at("0")});
  run.seen[at("0")] = 4;
  const DefectCounts found = in_results(known, compare_defects(known, run, versions));
  ASSERT_THAT(found.defects, SizeIs(1));
  ASSERT_THAT(found.readings, SizeIs(1));
  EXPECT_EQ(found.readings[0].changed, 1u) << "watched as well";
  ASSERT_THAT(found.changed, SizeIs(1));
  EXPECT_THAT(found.changed[0].was, ElementsAre(3));
  EXPECT_THAT(found.changed[0].is, ElementsAre(4));
}

TEST(UpdatedDefects, TakeInWhatShowsUnderTheCauseOfItsPlace) {
  const KnownDefects now =
      updated(known_at({at("0")}), run_with({at("0"), at("1")}), kVersions, fcl);
  ASSERT_THAT(now.defects, SizeIs(1));
  EXPECT_THAT(now.defects[0].seen, ElementsAre(Pair(at("0"), 3), Pair(at("1"), 3)));
}

TEST(UpdatedDefects, TakeInTheCountsOfTheRun) {
  SightingsOfRun run = run_with({at("0"), at("1")});
  run.seen[at("1")] = 8;
  const KnownDefects now = updated(known_at({at("0"), at("1")}), run, kVersions, fcl);
  ASSERT_THAT(now.defects, SizeIs(1));
  EXPECT_THAT(now.defects[0].seen, ElementsAre(Pair(at("0"), 3), Pair(at("1"), 8)));
}

TEST(UpdatedDefects, LetWhatHasNoPlaceWaitForAnExplanation) {
  const KnownDefects now = updated(known_at({at("0")}),
                                   run_with({at("0"), at("1", kSpurious), at("1", kMissed, "tip"),
                                             at("2", kMissed, "tip"), at("1", kMissed, "top")}),
                                   kVersions, fcl);
  ASSERT_THAT(now.defects, SizeIs(3));
  EXPECT_EQ(now.defects[1].where, kUnexplained);
  EXPECT_EQ(now.defects[1].version, "0.7.0");
  EXPECT_THAT(now.defects[1].seen, SizeIs(1));
  EXPECT_THAT(now.defects[2].seen, SizeIs(3));
}

TEST(UpdatedDefects, TakeOutWhatDoesNotShowAndKeepWhatDidNotRun) {
  const auto run = run_with({}, {at("0"), at("0", kMissed, "tip")});
  const KnownDefects now = updated(known_at({at("0"), at("1")}), run, kVersions, fcl);
  ASSERT_THAT(now.defects, SizeIs(1));
  EXPECT_THAT(now.defects[0].seen, ElementsAre(Pair(at("1"), 3)));
  EXPECT_THAT(updated(known_at({at("0")}), run, kVersions, fcl).defects, IsEmpty());
}

TEST(UpdatedDefects, LeaveOtherVersionsAlone) {
  const KnownDefects now = updated(known_at({at("0"), at("1")}, "0.6.1"),
                                   run_with({at("0")}, {at("1")}), kVersions, fcl);
  ASSERT_THAT(now.defects, SizeIs(2));
  EXPECT_THAT(now.defects[0].seen, ElementsAre(Pair(at("0"), 3), Pair(at("1"), 3)));
  EXPECT_EQ(now.defects[1].version, "0.7.0");
}

}  // namespace
}  // namespace contactcheck::results
