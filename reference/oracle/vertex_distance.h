// The distance from a vertex to one triangle or box: in double with proven bounds, or exact.
//
// A degenerate triangle is treated as a segment or a point.
#pragma once

#include "core/types/vec3.h"
#include "reference/oracle/exact_predicates.h"

namespace contactcheck::oracle {

/// A lower bound of the distance from a point to a box, 0 inside; off by less than 2e-15 of it.
/// @pre no square of an offset overflows
double distance_to(const Aabb& box, const Vec3& point);

/// A point of the triangle, up to rounding, with bounds of the distance from vertex to triangle.
struct NearestPoint {
  Vec3 offset = Vec3::Zero();       ///< from the vertex to the point
  double lower = 0.0, upper = 0.0;  ///< lower <= true distance <= upper
};

/// Mostly 1e-13 of the offsets' size wide; wider for slivers and if the vertex nearly touches an
/// edge. If the largest offset to a corner is outside [2^-200, 2^200] (0 included), lower is 0 and
/// upper is infinite.
NearestPoint nearest_point(const Vec3& vertex, const TriangleCorners& triangle);

/// The nearest point itself, each coordinate rounded, and bounds a few units in the last place wide
/// (2e-154 at most below 1e-150). A few hundred times slower.
/// @pre the squares of the offsets are finite
NearestPoint exact_nearest_point(const Vec3& vertex, const TriangleCorners& triangle);

/// True when the distance is strictly below `margin`; exact for every finite input.
bool nearer_than(double margin, const Vec3& vertex, const TriangleCorners& triangle);

}  // namespace contactcheck::oracle
