// Limits of Bullet 3.24 in single precision.
#include "tests/conformance/known_deviations.h"

namespace contactcheck::test {
namespace {

std::vector<KnownDeviation> bullet_vf() {
  const DetectorNames both = {"bullet-vf", "bullet-vf:scale=1"};
  const auto seen = [](const char* source) { return Origin{"bullet", "3.24 float", source}; };
  return {
      {both,
       "body missed",
       {{"moving", 6},
        {"touching-edge-edge", 1},
        {"crossing", 2},
        {"eight-identical-spread", 12},
        {"isolated-vertex", 1},
        {"two-components", 1},
        {"long-triangles", 1},
        {"inside-out", 1},
        {"a-thousand-kilometres-wide", 1}},
       seen("prior-art.md 3.4 B2; peers.md, touch-edge-edge-cross"),
       "VF_SS tests vertices against faces: edges that cross, and vertices deeper inside than the "
       "margins, are no contact"},
      {{"bullet-vf:scale=1"},
       "body missed",
       {{"triangles-of-a-centimetre", 1}, {"a-millimetre-wide", 1}, {"a-micrometre-wide", 1}},
       seen("prior-art.md 3.4 B1; btSoftBodyInternals.h"),
       "faces whose cross product squared is below FLT_EPSILON are skipped: fine meshes are "
       "invisible"},
      {{"bullet-vf:scale=1"},
       "near missed",
       {{"triangles-of-a-centimetre", 8},
        {"a-millimetre-wide", 16432},
        {"a-micrometre-wide", 33792}},
       seen("prior-art.md 3.4 B1; btSoftBodyInternals.h"),
       "faces whose cross product squared is below FLT_EPSILON are skipped: fine meshes are "
       "invisible"},
      {{"bullet-vf", "bullet-vf:scale=1"},
       "self-near missed",
       {{"open-mesh", 18}},
       seen("btDbvt.h, selfCollideT"),
       "a part of the tree whose cone of normals is no wider than pi is not compared with itself"},
      {{"bullet-vf"},
       "self-near missed",
       {{"a-millimetre-wide", 11616}, {"a-micrometre-wide", 8568}},
       seen("btDbvt.h, selfCollideT"),
       "a part of the tree whose cone of normals is no wider than pi is not compared with itself"},
      {{"bullet-vf:scale=1"},
       "self-near missed",
       {{"a-millimetre-wide", 32256}, {"a-micrometre-wide", 32256}},
       seen("prior-art.md 3.4 B1; btSoftBodyInternals.h"),
       "faces whose cross product squared is below FLT_EPSILON are skipped: fine meshes are "
       "invisible"},
      {{"bullet-vf"},
       "body spurious",
       {{"a-millimetre-wide", 1}, {"a-micrometre-wide", 1}},
       seen("prior-art.md 3.4 B3"),
       "contact is being nearer than the two margins, which are wider than these bodies"},
  };
}

std::vector<KnownDeviation> bullet_cl() {
  const DetectorNames clusters = {"bullet-cl"};
  const auto seen = [](const char* source) { return Origin{"bullet", "3.24 float", source}; };
  return {
      {clusters,
       "body spurious",
       {{"containment", 1}, {"open-mesh", 1}},
       seen("prior-art.md 3.4 B6"),
       "a cluster is the convex hull of its vertices, which is solid and reaches over concave "
       "places"},
      {clusters,
       "body spurious",
       {{"a-millimetre-wide", 1}, {"a-micrometre-wide", 1}},
       seen("prior-art.md 3.4 B3"),
       "contact is being nearer than the two margins, which are wider than these bodies"},
      {clusters,
       "self-body spurious",
       {{"a-millimetre-wide", 4}, {"a-micrometre-wide", 4}},
       seen("prior-art.md 3.4 B3"),
       "contact is being nearer than the two margins, which are wider than these bodies"},
      {clusters,
       "self-body missed",
       {{"open-mesh", 2}},
       seen("prior-art.md 3.4 B6"),
       "clusters of one body are compared where they share no vertex, and these do"},
      {clusters,
       "answer differs",
       {{"rebuilt-structure", 1}},
       seen("prior-art.md 3.4 B6"),
       "clusters are made of the shape at rest: of another one there are others, and their hulls "
       "hold other space"},
  };
}

std::vector<KnownDeviation> bullet_gimpact() {
  const DetectorNames gimpact = {"bullet-gimpact"};
  const auto seen = [](const char* source) { return Origin{"bullet", "3.24 float", source}; };
  return {
      {gimpact,
       "triangle spurious",
       {{"moving", 195},
        {"touching-edge-edge", 4},
        {"crossing", 14},
        {"coincident", 48},
        {"eight-identical-coincident", 224},
        {"eight-identical-spread", 48},
        {"isolated-vertex", 1},
        {"two-components", 2},
        {"long-triangles", 2},
        {"inside-out", 4},
        {"triangles-of-a-centimetre", 12},
        {"a-millimetre-wide", 12},
        {"a-micrometre-wide", 12},
        {"a-thousand-kilometres-wide", 12}},
       seen("peers.md, GImpact; issues 98 and 106"),
       "a triangle is clipped to the prism over the other one and need only lie behind its plane"},
      {gimpact,
       "triangle missed",
       {{"touching-vertex-face", 1},
        {"coincident-balls", 192},
        {"isolated-vertex", 1},
        {"open-mesh", 10},
        {"two-components", 2}},
       seen("peers.md, hard case spheres-identical"),
       "parts that touch a prism's side, or a plane, within rounding are clipped away"},
      {gimpact,
       "triangle missed",
       {{"zero-area-triangles", 5}},
       seen("peers.md, hard cases degenerate-segment and degenerate-point"),
       "a triangle without area has a plane of NaN and meets nothing"},
      {gimpact,
       "triangle missed",
       {{"touching-far-from-the-origin", 3}},
       seen("prior-art.md 3.4 B12"),
       "far from the origin single precision leaves no digits for differences"},
  };
}

}  // namespace

std::vector<KnownDeviation> known_deviations_of_bullet() {
  std::vector<KnownDeviation> all;
  for (const auto& part : {bullet_vf(), bullet_cl(), bullet_gimpact()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace contactcheck::test
