// Pairs of triangles that touch or just do not, each kind hard in a way of its own.
#pragma once

#include <array>
#include <cstddef>

#include "core/types/vec3.h"
#include "reference/scene/pair_random.h"

namespace contactcheck {

/// Where two triangles all but touch, or what they are.
enum class PairKind {
  kVertexFace,    ///< a corner on a face
  kVertexEdge,    ///< a corner on an edge
  kEdgeEdge,      ///< two edges that cross
  kVertexVertex,  ///< a common corner
  kSharedEdge,    ///< two common corners
  kNearCoplanar,  ///< the corners of one in the plane of the other, as near as rounding lets them
  kCoplanar,      ///< exactly in one plane, with corners on one coarse grid
  kSliver,        ///< one triangle is a few units in the last place wide
  kSegment,       ///< one triangle, or both, are exactly a segment
  kPoint,         ///< one triangle is exactly a point
  kMixedScale     ///< one triangle is 2^10 to 2^40 times the other
};
constexpr std::size_t kPairKinds = 11;
const char* name_of(PairKind kind);

/// Where a pair is made: around `center`, the larger triangle about `size` metres.
struct PairPlace {
  Vec3 center = Vec3::Zero();
  double size = 1.0;
};

struct HardPair {
  std::array<Vec3, 3> a, b;
};

/// No corner is farther from the center than this many sizes, along any axis.
constexpr double kPairReach = 7.0;

/// Points of contact are computed in double, so that they are off by rounding alone, then moved by
/// up to two units in the last place in about half of the pairs. Additions, products, quotients and
/// square roots of doubles alone: the same bits on every machine.
HardPair make_hard_pair(PairKind kind, const PairPlace& place, PairRandom& random);

}  // namespace contactcheck
