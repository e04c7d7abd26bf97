#include "core/narrow/segments.h"

#include <utility>

#include "core/narrow/predicates.h"
#include "core/narrow/predicates_single.h"

namespace contactcheck {
namespace {

/// Neither +1 and -1 among the three: on the same closed side of all of them.
bool agree(int a, int b, int c) {
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

/// @pre `axis` projects a plane that holds all points one to one; not all four collinear
template <typename T>
bool coplanar_segments_meet(const SegmentOf<T>& s, const SegmentOf<T>& t, int axis) {
  if (orient2d(s.from, s.to, t.from, axis) * orient2d(s.from, s.to, t.to, axis) > 0) return false;
  return orient2d(t.from, t.to, s.from, axis) * orient2d(t.from, t.to, s.to, axis) <= 0;
}

template <typename T>
bool collinear_segments_meet(const SegmentOf<T>& s, const SegmentOf<T>& t) {
  return !before(s.to, t.from) && !before(t.to, s.from);
}

/// An axis along which a, b, c keep a non-zero area, or -1 when they are collinear.
template <typename T>
int projection_axis(const Vec3Of<T>& a, const Vec3Of<T>& b, const Vec3Of<T>& c) {
  for (int axis = 0; axis < 3; ++axis)
    if (orient2d(a, b, c, axis) != 0) return axis;
  return -1;
}

/// @pre the point lies in the triangle's plane
template <typename T>
bool coplanar_point_on_triangle(const Vec3Of<T>& p, const ProperTriangleOf<T>& triangle) {
  const auto& [a, b, c] = triangle.corners;
  const int axis = triangle.axis;
  return agree(orient2d(a, b, p, axis), orient2d(b, c, p, axis), orient2d(c, a, p, axis));
}

/// @pre the segment lies in the triangle's plane. It meets the triangle when it starts on it or
/// meets an edge: a segment that starts outside and reaches the triangle crosses the boundary.
template <typename T>
bool coplanar_segment_meets_triangle(const SegmentOf<T>& segment,
                                     const ProperTriangleOf<T>& triangle) {
  if (coplanar_point_on_triangle(segment.from, triangle)) return true;
  const auto& [a, b, c] = triangle.corners;
  return segments_meet(segment, ordered_segment(a, b)) ||
         segments_meet(segment, ordered_segment(b, c)) ||
         segments_meet(segment, ordered_segment(c, a));
}

}  // namespace

template <typename T>
bool before(const Vec3Of<T>& a, const Vec3Of<T>& b) {
  if (a.x() != b.x()) return a.x() < b.x();
  if (a.y() != b.y()) return a.y() < b.y();
  return a.z() < b.z();
}

template <typename T>
SegmentOf<T> ordered_segment(const Vec3Of<T>& a, const Vec3Of<T>& b) {
  return before(b, a) ? SegmentOf<T>{b, a} : SegmentOf<T>{a, b};
}

template <typename T>
bool point_on_segment(const Vec3Of<T>& point, const SegmentOf<T>& segment) {
  if (before(point, segment.from) || before(segment.to, point)) return false;
  return collinear(segment.from, segment.to, point);
}

template <typename T>
bool point_on_triangle(const Vec3Of<T>& point, const ProperTriangleOf<T>& triangle) {
  const auto& [a, b, c] = triangle.corners;
  return orient3d(a, b, c, point) == 0 && coplanar_point_on_triangle(point, triangle);
}

template <typename T>
bool segments_meet(const SegmentOf<T>& s, const SegmentOf<T>& t) {
  if (orient3d(s.from, s.to, t.from, t.to) != 0) return false;
  int axis = projection_axis(s.from, s.to, t.from);
  if (axis < 0) axis = projection_axis(s.from, s.to, t.to);
  return axis < 0 ? collinear_segments_meet(s, t) : coplanar_segments_meet(s, t, axis);
}

template <typename T>
bool segment_meets_triangle(const SegmentOf<T>& segment, const ProperTriangleOf<T>& triangle) {
  const auto& [a, b, c] = triangle.corners;
  const auto& [from, to] = segment;
  const int side_from = orient3d(a, b, c, from), side_to = orient3d(a, b, c, to);
  if (side_from * side_to > 0) return false;
  if (side_from == 0 && side_to == 0) return coplanar_segment_meets_triangle(segment, triangle);
  // The line meets the plane in one point, and that point is on the segment. It is on the triangle
  // when the line passes no two edges on opposite sides.
  return agree(orient3d(from, to, a, b), orient3d(from, to, b, c), orient3d(from, to, c, a));
}

#define CONTACTCHECK_SEGMENTS_OF(T)                                              \
  template bool before(const Vec3Of<T>&, const Vec3Of<T>&);                      \
  template SegmentOf<T> ordered_segment(const Vec3Of<T>&, const Vec3Of<T>&);     \
  template bool point_on_segment(const Vec3Of<T>&, const SegmentOf<T>&);         \
  template bool point_on_triangle(const Vec3Of<T>&, const ProperTriangleOf<T>&); \
  template bool segments_meet(const SegmentOf<T>&, const SegmentOf<T>&);         \
  template bool segment_meets_triangle(const SegmentOf<T>&, const ProperTriangleOf<T>&)
CONTACTCHECK_SEGMENTS_OF(double);
CONTACTCHECK_SEGMENTS_OF(float);

}  // namespace contactcheck
