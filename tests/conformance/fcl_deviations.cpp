// Limits of FCL 0.7.0.
#include "tests/conformance/known_deviations.h"

namespace contactcheck::test {

std::vector<KnownDeviation> known_deviations_of_fcl() {
  const DetectorNames all = {"fcl-aabb", "fcl-obbrss", "fcl-collide"};
  const DetectorNames oriented = {"fcl-obbrss"};
  const auto seen = [](const char* source) { return Origin{"fcl", "0.7.0", source}; };
  return {
      {all,
       "triangle spurious",
       {{"crossing", 1}},
       seen("detail::Intersect::intersect_Triangle"),
       "the separating axes of two triangles are tried in plain double: a gap below rounding is "
       "none"},
      {all,
       "contradiction",
       {{"zero-area-triangles", 1}},
       seen("prior-art.md 3.1 F7"),
       "with contact points asked for, pairs of a triangle without area are dropped, since its "
       "plane cannot be built"},
      {all,
       "answer differs",
       {{"swapped-bodies", kSome}},
       seen("issues 8, 384 and 163"),
       "rounding of the triangle test, and what is made of triangles without area, depend on which "
       "body comes first"},
      {oriented,
       "triangle missed",
       {{"coincident", 2}, {"zero-area-triangles", 2}},
       seen("peers.md, hard cases cubes8-coincident and spheres-identical"),
       "the overlap test of oriented boxes rounds, and flat boxes have no slack"},
      {oriented,
       "self missed",
       {{"open-mesh", 4}},
       seen("peers.md, hard cases cubes8-coincident and spheres-identical"),
       "the overlap test of oriented boxes rounds, and flat boxes have no slack"},
      {oriented,
       "self spurious",
       {{"zero-area-triangles", 4}},
       seen("detail::Intersect::intersect_Triangle on triangles without area"),
       "a triangle without area has no normal, and the axes that are left do not separate"},
  };
}

}  // namespace contactcheck::test
