// Limits of FCL 0.7.0.
#include "tests/conformance/known_deviations.h"

namespace contactcheck::test {

std::vector<KnownDeviation> known_deviations_of_fcl() {
  const DetectorNames all = {"fcl-aabb", "fcl-obbrss", "fcl-collide"};
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
  };
}

}  // namespace contactcheck::test
