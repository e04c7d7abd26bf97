// How deep two solids are in each other: a certified interval of their surface depth.
//
// The largest distance from a point of either surface that lies inside the other solid to that
// solid's surface. Crossed bars without a vertex inside are deep; so is a body inside another one.
#pragma once

#include <limits>

#include "reference/oracle/surface_tree.h"
#include "reference/oracle/triangle_distance.h"

namespace contactcheck::oracle {

/// After so many pieces the search ends, and gives the interval that it has.
inline constexpr int kMostDepthPieces = 100'000;

/// How narrow an interval is wanted: at most a thousandth of its upper end, or 1e-9 of the largest
/// |coordinate|. An interval that holds `limit` is narrowed to the latter; one at most `limit` may
/// be as wide as it is.
struct DepthWanted {
  double limit = -std::numeric_limits<double>::infinity();
  int pieces = kMostDepthPieces;
};

/// lower <= depth <= upper. Both are 0 where no point of either surface can lie inside the other;
/// surfaces that only touch have a lower end of 0 and an upper end of at most 1e-9. Wider than
/// wanted only where the pieces ran out.
/// @pre both are simple solids (simple_solid.h), their trees fitted to |coordinates| <= 1
DistanceBounds surface_depth(const SurfaceTree& a, const SurfaceTree& b,
                             const DepthWanted& wanted = {});

}  // namespace contactcheck::oracle
