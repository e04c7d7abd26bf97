// Points, segments and proper triangles: which of them share a point. Exact and closed.
//
// The building blocks of the triangle tests for touching, coplanar and degenerate input. Only signs
// of exact predicates and comparisons of coordinates decide. @pre all coordinates finite
#pragma once

#include <array>

#include "core/types/vec3.h"

namespace contactcheck {

/// A closed segment, ordered: from comes before to in the order of coordinates (x, then y, then z),
/// so that on one line this order is the order of points.
struct Segment {
  Vec3 from, to;
};

/// A triangle whose corners are not collinear, with an axis along which it can be projected without
/// its corners becoming collinear.
struct ProperTriangle {
  std::array<Vec3, 3> corners;
  int axis;
};

/// True when a comes before b: lower x, or equal x and lower y, or both equal and lower z.
bool before(const Vec3& a, const Vec3& b);

/// An axis along which a, b, c keep a non-zero area, or -1 when they are collinear.
int projection_axis(const Vec3& a, const Vec3& b, const Vec3& c);

Segment ordered_segment(const Vec3& a, const Vec3& b);

bool point_on_segment(const Vec3& point, const Segment& segment);
bool point_on_triangle(const Vec3& point, const ProperTriangle& triangle);
bool segments_meet(const Segment& s, const Segment& t);
bool segment_meets_triangle(const Segment& segment, const ProperTriangle& triangle);

}  // namespace contactcheck
