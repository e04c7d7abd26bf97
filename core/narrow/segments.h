// Points, segments and proper triangles: which of them share a point. Closed; exact in doubles.
//
// The building blocks of the triangle tests for touching, coplanar and degenerate input. Only signs
// of predicates and comparisons of coordinates decide. T: double, whose predicates are exact, or
// float, whose predicates are not (predicates_single.h). @pre all coordinates finite
#pragma once

#include <array>

#include "core/types/vec3.h"

namespace contactcheck {

/// A closed segment, ordered: from comes before to in the order of coordinates (x, then y, then z),
/// so that on one line this order is the order of points.
template <typename T>
struct SegmentOf {
  Vec3Of<T> from, to;
};
using Segment = SegmentOf<double>;

/// A triangle whose corners are not collinear, with an axis along which it can be projected without
/// its corners becoming collinear.
template <typename T>
struct ProperTriangleOf {
  std::array<Vec3Of<T>, 3> corners;
  int axis;
};
using ProperTriangle = ProperTriangleOf<double>;

/// True when a comes before b: lower x, or equal x and lower y, or both equal and lower z.
template <typename T>
bool before(const Vec3Of<T>& a, const Vec3Of<T>& b);

template <typename T>
SegmentOf<T> ordered_segment(const Vec3Of<T>& a, const Vec3Of<T>& b);

template <typename T>
bool point_on_segment(const Vec3Of<T>& point, const SegmentOf<T>& segment);
template <typename T>
bool point_on_triangle(const Vec3Of<T>& point, const ProperTriangleOf<T>& triangle);
template <typename T>
bool segments_meet(const SegmentOf<T>& s, const SegmentOf<T>& t);
template <typename T>
bool segment_meets_triangle(const SegmentOf<T>& segment, const ProperTriangleOf<T>& triangle);

}  // namespace contactcheck
