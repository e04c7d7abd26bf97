#include "tests/metamorphic/relations.h"

#include <cstdlib>
#include <utility>

#include "tests/metamorphic/movement.h"
#include "tests/metamorphic/renaming.h"

namespace contactcheck::test {
namespace {

using SubjectPtr = std::shared_ptr<const Subject>;

Relation renaming(std::string name, const Renaming& how) {
  return {std::move(name), [how](SubjectPtr s) { return renamed(std::move(s), how); }};
}

// Beyond this, squares leave the range of doubles.
constexpr int kFewExponents = 128;

Relation scaling(std::string name, int exponent, Rest rest) {
  return {.name = std::move(name),
          .variant = [=](SubjectPtr s) { return scaled(std::move(s), exponent, rest); },
          .margins = std::abs(exponent) <= kFewExponents};
}

Relation moving_with_rounding() {
  return {.name = "MovedWithRounding", .variant = moved_with_rounding, .judged_anew = true};
}

Relation axis_turning(std::string name, bool mirrored) {
  return {std::move(name),
          [=](SubjectPtr s) { return turned_to_other_axes(std::move(s), mirrored); }};
}

Relation translation(std::string name, int exponent, Carrier carrier) {
  return {std::move(name),
          [=](SubjectPtr s) { return translated(std::move(s), exponent, carrier); }};
}

Relation calling(std::string name, Calls calls) {
  return {std::move(name), unchanged, std::move(calls)};
}

const Renaming kAllIds = {true, true, true, true, true};

}  // namespace

const std::vector<Relation>& relations_of_cases() {
  static const std::vector<Relation> relations = {
      renaming("SwappedBodies", {.reverse_bodies = true}),
      renaming("FlippedWinding", {.flip_winding = true}),
      renaming("ShuffledTriangles", {.shuffle_triangles = true}),
      renaming("ShuffledVertices", {.shuffle_vertices = true}),
      renaming("TurnedCorners", {.turn_corners = true}),
      renaming("AllIds", kAllIds),
      scaling("ScaledByTwo", 1, Rest::kStays),
      scaling("ScaledByTwoToThe64", 64, Rest::kStays),
      scaling("ScaledByTwoToTheMinus64", -64, Rest::kStays),
      scaling("ScaledByTwoToThe480", 480, Rest::kStays),
      scaling("ScaledByTwoToTheMinus480", -480, Rest::kStays),
      scaling("ScaledWithRestBy1024", 10, Rest::kMoves),
      scaling("ScaledWithRestByTwoToTheMinus100", -100, Rest::kMoves),
      {.name = "ScaledToTheLargest", .variant = scaled_to_the_largest, .margins = false},
      {.name = "ScaledToTheSmallest", .variant = scaled_to_the_smallest, .margins = false},
      translation("TranslatedByItsSize", 0, Carrier::kNodes),
      translation("TranslatedByAMillionSizes", 20, Carrier::kNodes),
      translation("TranslatedToTheLastDigits", 44, Carrier::kNodes),
      axis_turning("TurnedToOtherAxes", false),
      axis_turning("Mirrored", true),
      moving_with_rounding(),
      calling("FreshDetector", ask_fresh_detector),
      calling("RepeatedQuery", ask_repeatedly),
      calling("RepeatedUpdate", update_repeatedly),
      calling("AfterOtherFrame", ask_after_other_frame),
      calling("AfterFarFrame", ask_after_far_frame),
      calling("WithContacts", ask_with_contacts)};
  return relations;
}

// Scaled to one end of the doubles, where exact arithmetic decides much; hard cases go to both.
const std::vector<Relation>& relations_of_scenes() {
  static const std::vector<Relation> relations = {
      renaming("AllIds", kAllIds),
      scaling("ScaledByTwoToThe64", 64, Rest::kStays),
      scaling("ScaledByTwoToTheMinus480", -480, Rest::kStays),
      translation("TranslatedByThousandsOfSizes", 12, Carrier::kBare),
      axis_turning("TurnedToOtherAxes", false),
      axis_turning("Mirrored", true),
      moving_with_rounding(),
      calling("FreshDetector", ask_fresh_detector),
      calling("AfterAll", ask_after_all)};
  return relations;
}

}  // namespace contactcheck::test
