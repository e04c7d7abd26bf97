// Limits of libccd 2.1, and of the boxes that it is given.
//
// Which touching pairs are lost is the luck of rounding, down to the order of the support points:
// their number is not held.
#include "tests/conformance/known_deviations.h"

namespace contactcheck::test {
namespace {

const char* const kVersion = "2.1 (its own files say 2.0)";

const char* const kOriginOnSimplex =
    "GJK takes a difference whose origin lies on the simplex, as in touching and flat pieces, for "
    "one without it";
const char* const kTouchingIsNone = "MPR wants the origin inside the portal: touching is none";

std::vector<KnownDeviation> libccd_triangles() {
  const DetectorNames gjk = {"libccd-gjk"}, mpr = {"libccd-mpr"};
  const auto seen = [](const char* source) { return Origin{"libccd", kVersion, source}; };
  return {
      {gjk,
       "triangle missed",
       {{"touching-vertex-vertex", kSome},
        {"coincident", kSome},
        {"coincident-balls", kSome},
        {"eight-identical-coincident", kSome}},
       seen("peers.md, libccd as narrow phase; prior-art.md 3.2 G12"),
       kOriginOnSimplex},
      {mpr,
       "triangle missed",
       {{"touching-vertex-vertex", kSome},
        {"coplanar-overlap", kSome},
        {"coincident", kSome},
        {"coincident-balls", kSome},
        {"eight-identical-coincident", kSome},
        {"zero-area-triangles", kSome},
        {"touching-far-from-the-origin", kSome}},
       seen("prior-art.md 3.3 C8"),
       kTouchingIsNone},
      {mpr,
       "body missed",
       {{"touching-vertex-vertex", 1}},
       seen("prior-art.md 3.3 C8"),
       kTouchingIsNone},
      {gjk + mpr,
       "triangle spurious",
       {{"crossing", 2}},
       seen("peers.md, libccd as narrow phase"),
       "a gap below the tolerances is none"},
      {gjk,
       "answer differs",
       {{"swapped-bodies", 4}},
       seen("prior-art.md 3.2 G12"),
       "which touching pairs are lost depends on which triangle comes first"},
  };
}

std::vector<KnownDeviation> libccd_boxes() {
  const DetectorNames gjk = {"libccd-gjk:pieces=boxes"}, mpr = {"libccd-mpr:pieces=boxes"};
  const auto seen = [](const char* source) { return Origin{"libccd", kVersion, source}; };
  return {
      {gjk,
       "box missed",
       {{"touching-vertex-vertex", kSome},
        {"touching-edge-edge", kSome},
        {"coincident", kSome},
        {"coincident-balls", kSome},
        {"eight-identical-coincident", kSome},
        {"two-components", kSome}},
       seen("prior-art.md 3.2 G12"),
       kOriginOnSimplex},
      {mpr,
       "box missed",
       {{"touching-vertex-vertex", kSome},
        {"touching-vertex-face", kSome},
        {"touching-edge-edge", kSome},
        {"coplanar-overlap", kSome},
        {"coincident", kSome},
        {"coincident-balls", kSome},
        {"eight-identical-coincident", kSome},
        {"open-mesh", kSome},
        {"two-components", kSome},
        {"touching-far-from-the-origin", kSome}},
       seen("prior-art.md 3.3 C8"),
       kTouchingIsNone},
      {mpr,
       "cell missed",
       {{"touching-vertex-vertex", kSome}, {"touching-edge-edge", kSome}},
       seen("prior-art.md 3.3 C8"),
       kTouchingIsNone},
      {mpr,
       "body missed",
       {{"touching-vertex-vertex", 1}, {"touching-edge-edge", 1}},
       seen("prior-art.md 3.3 C8"),
       kTouchingIsNone},
      {gjk,
       "answer differs",
       {{"swapped-bodies", kSome}},
       seen("prior-art.md 3.2 G12"),
       "which touching pairs are lost depends on which box comes first"},
      {gjk + mpr,
       "refused",
       {{"rebuilt-structure", 1}},
       {"contactcheck", "any options", "fixtures/README.md, level box"},
       "boxes are those of lattice cells: a body without a lattice has none"},
  };
}

// The library is right about the boxes here, and the boxes are not the surface.
std::vector<KnownDeviation> libccd_boxes_beside_the_surface() {
  const DetectorNames gjk = {"libccd-gjk:pieces=boxes"}, mpr = {"libccd-mpr:pieces=boxes"};
  const Origin boxes = {"contactcheck", "any options", "Jeon et al. 2013, FFD-AABB"};
  return {
      {gjk + mpr,
       "body spurious",
       {{"moving", 1},
        {"containment", 1},
        {"diagonal-neighbours", 1},
        {"eight-identical-spread", 16},
        {"isolated-vertex", 1},
        {"open-mesh", 1},
        {"two-components", 1}},
       boxes,
       kBoxesMeet},
      {gjk + mpr,
       "cell spurious",
       {{"moving", 233},
        {"touching-vertex-face", 2},
        {"crossing", 22},
        {"diagonal-neighbours", 67},
        {"eight-identical-spread", 52},
        {"isolated-vertex", 8},
        {"inside-out", 4},
        {"triangles-of-a-centimetre", 8},
        {"a-millimetre-wide", 8},
        {"a-micrometre-wide", 8},
        {"a-thousand-kilometres-wide", 8}},
       boxes,
       kBoxesMeet},
      {gjk,
       "cell spurious",
       {{"coincident", 4},
        {"coincident-balls", 4},
        {"containment", 180},
        {"open-mesh", 104},
        {"two-components", 36}},
       boxes,
       kBoxesMeet},
      {mpr,
       "cell spurious",
       {{"containment", 180}, {"open-mesh", 80}, {"two-components", 38}},
       boxes,
       kBoxesMeet},
  };
}

}  // namespace

std::vector<KnownDeviation> known_deviations_of_libccd() {
  std::vector<KnownDeviation> all;
  for (const auto& part : {libccd_triangles(), libccd_boxes(), libccd_boxes_beside_the_surface()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace contactcheck::test
