// Counts of differences depend on how libraries were compiled: only that there are some is held.
// Refusals do not.
#include "tests/metamorphic/library_deviations.h"

namespace contactcheck::test {
namespace {

constexpr const char* kDiffers = "answer differs";

std::vector<Occurrence> in(const std::vector<std::string>& relations) {
  std::vector<Occurrence> out;
  for (const std::string& relation : relations) out.push_back({relation, kSome});
  return out;
}

std::vector<KnownDeviation> of_fcl() {
  const auto seen = [](const char* source) { return Origin{"fcl", "0.7.0", source}; };
  const Origin triangles = seen("detail::Intersect::intersect_Triangle");
  return {{{"fcl-aabb", "fcl-obbrss", "fcl-collide"},
           kDiffers,
           in({"SwappedBodies", "TurnedCorners", "TurnedToOtherAxes", "Mirrored"}),
           triangles,
           "separating axes of two triangles are tried in plain double, from the first corner of "
           "the first: what is nearly in one plane is rounded in another way"},
          {{"fcl-obbrss"},
           kDiffers,
           in({"FlippedWinding", "ShuffledTriangles"}),
           seen("hard cases hard-boxes-gap, 2026"),
           "the oriented boxes that are fitted depend on the order of triangles and corners, and "
           "their overlap test rounds: touching and coincident surfaces lose other pairs"}};
}

std::vector<KnownDeviation> of_bullet() {
  const auto seen = [](const char* source) { return Origin{"bullet", "3.24 float", source}; };
  return {{{"bullet-gimpact"},
           kDiffers,
           in({"FlippedWinding", "TurnedCorners", "TurnedToOtherAxes", "Mirrored"}),
           seen("its clip test, see bullet_gimpact.cpp"),
           "triangles have a front and a back, and are clipped in the order of their corners, in "
           "single precision"},
          {{"bullet-vf"},
           kDiffers,
           in({"ShuffledTriangles", "TurnedToOtherAxes", "Mirrored"}),
           seen("btDbvt.h, selfCollideT"),
           "which parts of a body are compared with themselves is said by cones of normals in its "
           "tree, and the tree depends on the order of faces, and on the axes where boxes tie"},
          {{"bullet-vf", "bullet-cl", "bullet-gimpact"},
           kDiffers,
           in({"ScaledByTwo"}),
           seen("margins of the adapters, hard cases, 2026"),
           "margins are lengths, whatever the size of the scene"},
          {{"bullet-vf", "bullet-cl", "bullet-gimpact"},
           "refused",
           {{"SwappedBodies", 1},
            {"FlippedWinding", 1},
            {"ShuffledTriangles", 1},
            {"ShuffledVertices", 1},
            {"TurnedCorners", 1},
            {"ScaledByTwo", 1},
            {"TurnedToOtherAxes", 1},
            {"Mirrored", 1},
            {"FreshDetector", 1},
            {"RepeatedQuery", 1},
            {"AfterOtherFrame", 1},
            {"WithContacts", 1}},
           seen("btScalar = float"),
           "hard-scale-gap has coordinates beyond the largest float"}};
}

std::vector<KnownDeviation> of_libccd() {
  const auto seen = [](const char* source) { return Origin{"libccd", "2.1", source}; };
  return {
      {{"libccd-gjk", "libccd-mpr", "libccd-gjk:pieces=boxes", "libccd-mpr:pieces=boxes"},
       kDiffers,
       in({"SwappedBodies", "TurnedToOtherAxes", "Mirrored"}),
       seen("ccdGJKIntersect, ccdMPRIntersect; CCD_EPS"),
       "both end on absolute tolerances, and their way there depends on which piece comes first "
       "and on the axes"},
      {{"libccd-gjk", "libccd-mpr"},
       kDiffers,
       in({"FlippedWinding", "TurnedCorners"}),
       seen("ccdGJKIntersect, ccdMPRIntersect"),
       "the way to the answer depends on the order of a piece's corners, and it is rounded"}};
}

}  // namespace

const std::vector<KnownDeviation>& library_deviations() {
  static const std::vector<KnownDeviation> table = [] {
    std::vector<KnownDeviation> all;
    for (const auto& part : {of_fcl(), of_bullet(), of_libccd()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return table;
}

}  // namespace contactcheck::test
