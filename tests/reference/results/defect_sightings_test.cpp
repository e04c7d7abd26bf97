#include "reference/results/known_defects.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "reference/results/results_json.h"

namespace contactcheck::results {
namespace {

using Json = nlohmann::ordered_json;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using testing::SizeIs;

Json run(const char* scene, const char* detector, const char* status) {
  return {{"scene", scene}, {"detector", detector}, {"status", status}};
}

Json answers(const char* scene, const char* detector, const Json& missed, const Json& spurious) {
  Json out = run(scene, detector, "ok");
  out["per_frame"] = {{"level", "triangle"}, {"missed", missed}, {"spurious", spurious}};
  return out;
}

results::Results results_with(const Json& runs) {
  const Json gap = {{"id", "gap"},
                    {"truth", {{"triangle", 3}}},
                    {"family", {{"values", Json::array({"0", "1e-9", "1e-3"})}}}};
  const Json scene = {{"id", "bunny"}};
  return results::from_json({{"scenes", {gap, scene}}, {"runs", runs}});
}

TEST(Sightings, AreWrongAnswersToCases) {
  const auto found =
      sightings_of(results_with(Json::array({answers("gap", "d", {1, 0, 0}, {0, 0, 7})})));
  EXPECT_THAT(found.seen,
              ElementsAre(Pair(Sighting{"d", "gap", SightingKind::kMissed, "0"}, 1),
                          Pair(Sighting{"d", "gap", SightingKind::kSpurious, "1e-3"}, 7)));
  EXPECT_EQ(found.possible.count({"d", "gap", SightingKind::kMissed, "1e-9"}), 1u);
  EXPECT_EQ(found.possible.count({"d", "gap", SightingKind::kError, "1e-3"}), 1u);
  EXPECT_EQ(found.possible.count({"d", "gap", SightingKind::kRefused, "1e-3"}), 1u);
  EXPECT_THAT(found.possible, SizeIs(2 * 3 + 2 * (1 + 3)));
}

TEST(Sightings, OfScenesAreErrorsAlone) {
  const auto found = sightings_of(results_with(
      Json::array({answers("bunny", "d", {5, 0}, {0, 0}), run("bunny", "e", "error")})));
  EXPECT_THAT(found.seen,
              ElementsAre(Pair(Sighting{"e", "bunny", SightingKind::kError, kNoCase}, 1)));
}

TEST(Sightings, AnErrorTellsNothingOfLaterCases) {
  Json failed = run("gap", "d", "error");
  failed["failed_frame"] = 1u;
  const auto found = sightings_of(results_with(Json::array({failed})));
  EXPECT_THAT(found.seen, ElementsAre(Pair(Sighting{"d", "gap", SightingKind::kError, "1e-9"}, 1)));
  EXPECT_EQ(found.possible.count({"d", "gap", SightingKind::kError, "0"}), 1u);
  EXPECT_EQ(found.possible.count({"d", "gap", SightingKind::kError, "1e-3"}), 0u);
  EXPECT_EQ(found.possible.count({"d", "gap", SightingKind::kMissed, "0"}), 0u);
  EXPECT_EQ(found.possible.count({"d", "gap", SightingKind::kRefused, "0"}), 0u);
}

TEST(Sightings, ARefusalOfAFamilyIsOne) {
  Json refused = run("gap", "d", "refused");
  refused["failed_frame"] = 1u;
  const auto found = sightings_of(results_with(
      Json::array({refused, run("gap", "e", "refused"), run("bunny", "d", "refused")})));
  EXPECT_THAT(found.seen,
              ElementsAre(Pair(Sighting{"d", "gap", SightingKind::kRefused, "1e-9"}, 1),
                          Pair(Sighting{"e", "gap", SightingKind::kRefused, kNoCase}, 1)));
  EXPECT_EQ(found.possible.count({"d", "gap", SightingKind::kRefused, "0"}), 1u);
  EXPECT_EQ(found.possible.count({"d", "gap", SightingKind::kRefused, "1e-3"}), 0u);
}

TEST(Sightings, NoDetectorRefusesASceneThatWasRefusedItself) {
  results::Results results = results_with(Json::array({run("gap", "d", "refused")}));
  results.scenes.front().truth.clear();
  EXPECT_THAT(sightings_of(results).seen, IsEmpty());
}

TEST(Sightings, AnAbsentDetectorTellsNothing) {
  const auto found = sightings_of(results_with(Json::array({run("gap", "e", "absent")})));
  EXPECT_THAT(found.seen, IsEmpty());
  EXPECT_THAT(found.possible, IsEmpty());
}

TEST(Sightings, RefuseRowsThatDoNotBelongToTheScenes) {
  for (const Json& bad :
       {run("nowhere", "d", "ok"), answers("gap", "d", {0, 0, 0, 1}, {0, 0, 0, 0})})
    EXPECT_THROW(sightings_of(results_with(Json::array({bad}))), InputError) << bad;
}

}  // namespace
}  // namespace contactcheck::results
