// Certified bounds of the distance between two triangles.
#pragma once

#include "reference/oracle/exact_predicates.h"

namespace contactcheck::oracle {

/// lower <= true distance <= upper.
struct DistanceBounds {
  double lower = 0.0, upper = 0.0;
};

/// Bounds in double: a pair of points gives the upper one, a separating slab the lower one. Mostly
/// 1e-13 wide, wider for slivers and nearly touching corners. lower is 0 if no slab was found, and
/// positive only if the triangles are disjoint. Triangles may be degenerate.
/// @pre all |coordinates| <= 1
DistanceBounds distance_bounds(const TriangleCorners& p, const TriangleCorners& q);

/// A quick certified lower bound, from slabs along the two face normals; often 0.
/// @pre all |coordinates| <= 1
double slab_bound(const TriangleCorners& p, const TriangleCorners& q);

/// Bounds around the exact rational distance, a few units in the last place wide (2e-154 at most
/// below 1e-150); exactly [0, 0] if the triangles share a point. A few hundred times slower.
/// @pre all |coordinates| <= 1
DistanceBounds exact_distance_bounds(const TriangleCorners& p, const TriangleCorners& q);

/// Bounds of scaled surfaces times 2^exponent. Rounded outward if the result is subnormal or
/// scaling may have lost bits; [0, 0] stays.
DistanceBounds unscaled(const DistanceBounds& bounds, int exponent);

}  // namespace contactcheck::oracle
