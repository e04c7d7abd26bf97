#include "core/narrow/segments.h"

#include <utility>

#include "core/narrow/predicates.h"

namespace contactcheck {
namespace {

/// Neither +1 and -1 among the three: on the same closed side of all of them.
bool agree(int a, int b, int c) {
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

/// @pre `axis` projects a plane that holds all points one to one; not all four collinear
bool coplanar_segments_meet(const Segment& s, const Segment& t, int axis) {
  if (orient2d(s.from, s.to, t.from, axis) * orient2d(s.from, s.to, t.to, axis) > 0) return false;
  return orient2d(t.from, t.to, s.from, axis) * orient2d(t.from, t.to, s.to, axis) <= 0;
}

bool collinear_segments_meet(const Segment& s, const Segment& t) {
  return !before(s.to, t.from) && !before(t.to, s.from);
}

/// @pre the point lies in the triangle's plane
bool coplanar_point_on_triangle(const Vec3& p, const ProperTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  const int axis = triangle.axis;
  return agree(orient2d(a, b, p, axis), orient2d(b, c, p, axis), orient2d(c, a, p, axis));
}

/// @pre the segment lies in the triangle's plane. It meets the triangle when it starts on it or
/// meets an edge: a segment that starts outside and reaches the triangle crosses the boundary.
bool coplanar_segment_meets_triangle(const Segment& segment, const ProperTriangle& triangle) {
  if (coplanar_point_on_triangle(segment.from, triangle)) return true;
  const auto& [a, b, c] = triangle.corners;
  return segments_meet(segment, ordered_segment(a, b)) ||
         segments_meet(segment, ordered_segment(b, c)) ||
         segments_meet(segment, ordered_segment(c, a));
}

}  // namespace

int projection_axis(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int axis = 0; axis < 3; ++axis)
    if (orient2d(a, b, c, axis) != 0) return axis;
  return -1;
}

bool before(const Vec3& a, const Vec3& b) {
  if (a.x() != b.x()) return a.x() < b.x();
  if (a.y() != b.y()) return a.y() < b.y();
  return a.z() < b.z();
}

Segment ordered_segment(const Vec3& a, const Vec3& b) {
  return before(b, a) ? Segment{b, a} : Segment{a, b};
}

bool point_on_segment(const Vec3& point, const Segment& segment) {
  if (before(point, segment.from) || before(segment.to, point)) return false;
  return collinear(segment.from, segment.to, point);
}

bool point_on_triangle(const Vec3& point, const ProperTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  return orient3d(a, b, c, point) == 0 && coplanar_point_on_triangle(point, triangle);
}

bool segments_meet(const Segment& s, const Segment& t) {
  if (orient3d(s.from, s.to, t.from, t.to) != 0) return false;
  int axis = projection_axis(s.from, s.to, t.from);
  if (axis < 0) axis = projection_axis(s.from, s.to, t.to);
  return axis < 0 ? collinear_segments_meet(s, t) : coplanar_segments_meet(s, t, axis);
}

bool segment_meets_triangle(const Segment& segment, const ProperTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  const auto& [from, to] = segment;
  const int side_from = orient3d(a, b, c, from), side_to = orient3d(a, b, c, to);
  if (side_from * side_to > 0) return false;
  if (side_from == 0 && side_to == 0) return coplanar_segment_meets_triangle(segment, triangle);
  // The line meets the plane in one point, and that point is on the segment. It is on the triangle
  // when the line passes no two edges on opposite sides.
  return agree(orient3d(from, to, a, b), orient3d(from, to, b, c), orient3d(from, to, c, a));
}

}  // namespace contactcheck
