// Limits of FCL 0.7.0.
#include "tests/conformance/known_deviations.h"

namespace contactcheck::test {

namespace {

Origin seen(const char* source) { return {"fcl", "0.7.0", source}; }

std::vector<KnownDeviation> of_frames() {
  const DetectorNames all = {"fcl-aabb", "fcl-obbrss", "fcl-collide"};
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

// The detector claims no exactness; this is what that costs.
std::vector<KnownDeviation> of_steps() {
  const DetectorNames ccd = {"fcl-ccd"};
  const Origin node = seen("detail::MeshContinuousCollisionTraversalNode"),
               cubic = seen("detail::Intersect::intersect_VF and intersect_EE"),
               newton = seen("detail::Intersect::solveCubicWithIntervalNewton");
  const char* const kStart =
      "triangles in contact at the start are found, and timed, where a vertex and a triangle or "
      "two edges meet afterwards";
  const char* const kStill =
      "elements that do not move, or move in one plane, have a cubic without roots to test";
  const char* const kSmall =
      "a cubic whose coefficients are below 1e-7, an absolute number, is taken for one without "
      "roots";
  return {
      {ccd, "impact missed", {{"step-from-contact", 1}}, node, kStart},
      {ccd, "impact-triangle missed", {{"step-from-contact", 8}}, node, kStart},
      {ccd,
       "time late",
       {{"step-from-contact", 1}, {"step-a-thousand-kilometres-wide", 1}, {"step-moving", kSome}},
       node,
       kStart},
      {ccd, "impact missed", {{"step-no-motion", 2}, {"step-bare-triangles", 1}}, cubic, kStill},
      {ccd,
       "impact-triangle missed",
       {{"step-no-motion", 24}, {"step-slide", 11}, {"step-bare-triangles", 1}},
       cubic,
       kStill},
      {ccd,
       "impact missed",
       {{"step-a-millimetre-wide", 2}, {"step-a-micrometre-wide", 2}},
       cubic,
       kSmall},
      {ccd,
       "impact-triangle missed",
       {{"step-a-millimetre-wide", 44}, {"step-a-micrometre-wide", 44}},
       cubic,
       kSmall},
      {ccd,
       "time early",
       {{"step-moving", kSome}},
       newton,
       "roots are sought in intervals down to a width of 1e-7, and an end of one is the time"},
  };
}

}  // namespace

std::vector<KnownDeviation> known_deviations_of_fcl() {
  std::vector<KnownDeviation> all = of_frames();
  const std::vector<KnownDeviation> steps = of_steps();
  all.insert(all.end(), steps.begin(), steps.end());
  return all;
}

}  // namespace contactcheck::test
