#include "reference/results/defect_comparison.h"

#include <gmock/gmock.h>

namespace contactcheck::results {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr auto kMissed = SightingKind::kMissed;
constexpr auto kSpurious = SightingKind::kSpurious;
constexpr auto kError = SightingKind::kError;
const LibraryVersions kVersions = {{"fcl", "0.7.0"}};

Sighting at(const char* value, SightingKind kind = kMissed, const char* scene = "gap") {
  return {"fcl-aabb", scene, kind, value};
}

KnownDefects known_at(const std::vector<Sighting>& seen, const char* version = "0.7.0") {
  return {{{"fcl", version, "502", seen.front().kind, "why", seen}}};
}

SightingsOfRun run_with(std::set<Sighting> seen, std::set<Sighting> unseen = {}) {
  SightingsOfRun run{seen, std::move(unseen)};
  run.possible.merge(seen);
  return run;
}

std::string fcl(const std::string&) { return "fcl"; }

TEST(DefectComparison, IsSilentWhereAllIsAsListed) {
  const auto found =
      compare_defects(known_at({at("0"), at("1")}), run_with({at("0"), at("1")}), kVersions);
  EXPECT_THAT(found.not_shown, IsEmpty());
  EXPECT_THAT(found.unlisted, IsEmpty());
  EXPECT_EQ(found.counts.at(0).listed, 2u);
  EXPECT_EQ(found.counts.at(0).shown, 2u);
}

TEST(DefectComparison, NamesWhatIsListedAndDoesNotShow) {
  const auto found =
      compare_defects(known_at({at("0"), at("1")}), run_with({at("0")}, {at("1")}), kVersions);
  EXPECT_THAT(found.not_shown, ElementsAre(at("1")));
  EXPECT_EQ(found.counts.at(0).shown, 1u);
}

TEST(DefectComparison, NamesWhatShowsAndIsNotListed) {
  const auto found =
      compare_defects(known_at({at("0")}), run_with({at("0"), at("0", kSpurious)}), kVersions);
  EXPECT_THAT(found.unlisted, ElementsAre(at("0", kSpurious)));
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
  EXPECT_THAT(found.unlisted, ElementsAre(at("0"))) << "of this version nothing is known";
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
  ASSERT_THAT(found.not_shown, SizeIs(1));
  EXPECT_EQ(found.not_shown[0].detector, "fcl-aabb");
  EXPECT_EQ(found.not_shown[0].scene, "gap");
  EXPECT_EQ(found.not_shown[0].kind, "missed");
  EXPECT_THAT(found.not_shown[0].values, ElementsAre("0", "1"));
  EXPECT_THAT(found.unlisted, SizeIs(2));
}

TEST(UpdatedDefects, TakeInWhatShowsUnderTheCauseOfItsPlace) {
  const KnownDefects now =
      updated(known_at({at("0")}), run_with({at("0"), at("1")}), kVersions, fcl);
  ASSERT_THAT(now.defects, SizeIs(1));
  EXPECT_THAT(now.defects[0].seen, ElementsAre(at("0"), at("1")));
}

TEST(UpdatedDefects, LetWhatHasNoPlaceWaitForAnExplanation) {
  const KnownDefects now = updated(known_at({at("0")}),
                                   run_with({at("0"), at("1", kSpurious), at("1", kMissed, "tip"),
                                             at("2", kMissed, "tip"), at("1", kMissed, "top")}),
                                   kVersions, fcl);
  ASSERT_THAT(now.defects, SizeIs(3));
  EXPECT_EQ(now.defects[1].issue, kUnexplained);
  EXPECT_EQ(now.defects[1].version, "0.7.0");
  EXPECT_THAT(now.defects[1].seen, SizeIs(1));
  EXPECT_THAT(now.defects[2].seen, SizeIs(3));
}

TEST(UpdatedDefects, TakeOutWhatDoesNotShowAndKeepWhatDidNotRun) {
  const auto run = run_with({}, {at("0"), at("0", kMissed, "tip")});
  const KnownDefects now = updated(known_at({at("0"), at("1")}), run, kVersions, fcl);
  ASSERT_THAT(now.defects, SizeIs(1));
  EXPECT_THAT(now.defects[0].seen, ElementsAre(at("1")));
  EXPECT_THAT(updated(known_at({at("0")}), run, kVersions, fcl).defects, IsEmpty());
}

TEST(UpdatedDefects, LeaveOtherVersionsAlone) {
  const KnownDefects now = updated(known_at({at("0"), at("1")}, "0.6.1"),
                                   run_with({at("0")}, {at("1")}), kVersions, fcl);
  ASSERT_THAT(now.defects, SizeIs(2));
  EXPECT_THAT(now.defects[0].seen, ElementsAre(at("0"), at("1")));
  EXPECT_EQ(now.defects[1].version, "0.7.0");
}

}  // namespace
}  // namespace contactcheck::results
