// Certified bounds of the distance between two triangles.
#pragma once

#include "reference/oracle/exact_predicates.h"

namespace contactcheck::oracle {

/// lower <= true distance <= upper.
struct DistanceBounds {
  double lower = 0.0, upper = 0.0;
};

/// Bounds in double: a pair of points gives the upper one, a separating slab the lower one. Mostly
/// 1e-13 wide, wider for slivers and for nearly touching corners; lower is 0 when no slab was
/// found, and positive only if the triangles are disjoint. Triangles may be degenerate.
/// @pre all |coordinates| <= 1
DistanceBounds distance_bounds(const TriangleCorners& p, const TriangleCorners& q);

/// A quick lower bound, from slabs along the two face normals; often 0. Certified likewise.
/// @pre all |coordinates| <= 1
double slab_bound(const TriangleCorners& p, const TriangleCorners& q);

/// Bounds around the exact rational distance, a few units in the last place wide (2e-154 at most
/// below 1e-150); exactly [0, 0] for triangles that share a point. Some hundred times slower.
/// @pre all |coordinates| <= 1
DistanceBounds exact_distance_bounds(const TriangleCorners& p, const TriangleCorners& q);

/// Bounds of scaled surfaces times 2^exponent. Rounded outward where the result is subnormal or was
/// of surfaces that scaling brought together; [0, 0] stays.
DistanceBounds unscaled(const DistanceBounds& bounds, int exponent);

}  // namespace contactcheck::oracle
