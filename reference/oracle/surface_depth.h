// The surface depth of two solids, as a certified interval.
//
// The depth is the largest distance from a point of either surface inside the other solid to that
// solid's surface. Crossed bars are deep although no vertex is inside; so is a body inside another.
#pragma once

#include <limits>

#include "reference/oracle/surface_tree.h"
#include "reference/oracle/triangle_distance.h"

namespace contactcheck::oracle {

/// After this many pieces the search stops and returns its present interval.
inline constexpr int kMostDepthPieces = 100'000;

/// The wanted width: at most a thousandth of the upper end, or 1e-9 of the largest |coordinate|. An
/// interval that contains `limit` is narrowed to the latter; an interval at or below `limit` may
/// have any width.
struct DepthWanted {
  double limit = -std::numeric_limits<double>::infinity();
  int pieces = kMostDepthPieces;
};

/// lower <= depth <= upper. Both are 0 if no point of either surface can lie inside the other; for
/// surfaces that only touch, lower is 0 and upper at most 1e-9. The interval is wider than wanted
/// only if the search used all its pieces.
/// @pre both are simple solids (simple_solid.h), their trees fitted to |coordinates| <= 1
DistanceBounds surface_depth(const SurfaceTree& a, const SurfaceTree& b,
                             const DepthWanted& wanted = {});

}  // namespace contactcheck::oracle
