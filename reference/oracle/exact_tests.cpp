#include "reference/oracle/exact_tests.h"

#include <algorithm>

#include "core/types/shared_corners.h"

namespace contactcheck::oracle {
namespace {

bool is_degenerate(const TriangleCorners& t) { return collinear(t[0], t[1], t[2]); }

// An axis along which the plane of three points projects one-to-one; -1 when they are collinear.
int injective_axis(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int axis = 0; axis < 3; ++axis)
    if (projected_orientation(a, b, c, axis) != 0) return axis;
  return -1;
}

// @pre the point lies on the segment's line
bool between(const Vec3& point, const Segment& s) {
  const bool forward = !lexicographically_less(s.to, s.from);
  const Vec3& low = forward ? s.from : s.to;
  const Vec3& high = forward ? s.to : s.from;
  return !lexicographically_less(point, low) && !lexicographically_less(high, point);
}

bool same_strict_side(int a, int b) { return a * b > 0; }

// @pre the point lies in the plane of the proper triangle, which `axis` projects one-to-one
bool coplanar_point_on_triangle(const Vec3& point, const TriangleCorners& t, int axis) {
  const int turn = projected_orientation(t[0], t[1], t[2], axis);
  for (int k = 0; k < 3; ++k)
    if (projected_orientation(t[k], t[(k + 1) % 3], point, axis) == -turn) return false;
  return true;
}

// @pre all four ends lie in one plane, which `axis` projects one-to-one
bool coplanar_segments_intersect(const Segment& p, const Segment& q, int axis) {
  const int q_from = projected_orientation(p.from, p.to, q.from, axis);
  const int q_to = projected_orientation(p.from, p.to, q.to, axis);
  const int p_from = projected_orientation(q.from, q.to, p.from, axis);
  const int p_to = projected_orientation(q.from, q.to, p.to, axis);
  if (same_strict_side(q_from, q_to) || same_strict_side(p_from, p_to)) return false;
  // Each line separates or touches the other's ends. If one touches, the end must lie on the
  // segment and not only on its line.
  if (q_from != 0 && q_to != 0 && p_from != 0 && p_to != 0) return true;
  return (q_from == 0 && between(q.from, p)) || (q_to == 0 && between(q.to, p)) ||
         (p_from == 0 && between(p.from, q)) || (p_to == 0 && between(p.to, q));
}

bool coplanar_segment_meets_triangle(const Segment& s, const TriangleCorners& t) {
  const int axis = injective_axis(t[0], t[1], t[2]);
  if (coplanar_point_on_triangle(s.from, t, axis)) return true;
  for (int k = 0; k < 3; ++k)
    if (coplanar_segments_intersect(s, {t[k], t[(k + 1) % 3]}, axis)) return true;
  return false;
}

// @pre the ends lie strictly on different sides of the triangle's plane
bool line_pierces_triangle(const Segment& s, const TriangleCorners& t) {
  bool positive = false, negative = false;
  for (int k = 0; k < 3; ++k) {
    const int side = orientation(s.from, s.to, t[k], t[(k + 1) % 3]);
    positive |= side > 0;
    negative |= side < 0;
  }
  return !(positive && negative);
}

bool segment_meets_proper(const Segment& s, const TriangleCorners& t) {
  const int from = orientation(t[0], t[1], t[2], s.from);
  const int to = orientation(t[0], t[1], t[2], s.to);
  if (same_strict_side(from, to)) return false;
  if (from == 0 && to == 0) return coplanar_segment_meets_triangle(s, t);
  if (from != 0 && to != 0) return line_pierces_triangle(s, t);
  return coplanar_point_on_triangle(from == 0 ? s.from : s.to, t, injective_axis(t[0], t[1], t[2]));
}

}  // namespace

bool point_on_segment(const Vec3& point, const Segment& segment) {
  return between(point, segment) && collinear(segment.from, segment.to, point);
}

bool point_on_triangle(const Vec3& point, const TriangleCorners& t) {
  const int axis = injective_axis(t[0], t[1], t[2]);
  if (axis < 0) return point_on_segment(point, segment_of_degenerate(t));
  return orientation(t[0], t[1], t[2], point) == 0 && coplanar_point_on_triangle(point, t, axis);
}

bool segments_intersect(const Segment& p, const Segment& q) {
  if (p.from == p.to) return point_on_segment(p.from, q);
  if (q.from == q.to) return point_on_segment(q.from, p);
  if (orientation(p.from, p.to, q.from, q.to) != 0) return false;
  int axis = injective_axis(p.from, p.to, q.from);
  if (axis < 0) axis = injective_axis(p.from, p.to, q.to);
  if (axis >= 0) return coplanar_segments_intersect(p, q, axis);
  // All on one line: the segments meet when an end of one lies on the other.
  return between(p.from, q) || between(p.to, q) || between(q.from, p);
}

bool segment_meets_triangle(const Segment& segment, const TriangleCorners& triangle) {
  if (is_degenerate(triangle)) {
    return segments_intersect(segment, segment_of_degenerate(triangle));
  }
  if (segment.from == segment.to) return point_on_triangle(segment.from, triangle);
  return segment_meets_proper(segment, triangle);
}

bool triangles_intersect(const TriangleCorners& p, const TriangleCorners& q) {
  if (is_degenerate(p)) return segment_meets_triangle(segment_of_degenerate(p), q);
  if (is_degenerate(q)) return segment_meets_triangle(segment_of_degenerate(q), p);
  return proper_triangles_intersect(p, q);
}

// A point other than the corner lies on a ray from it, and the ray leaves one of two proper
// triangles through the edge opposite the corner. A degenerate one is a segment that holds the
// corner: of either end, what lies between is shared or not.
bool meet_beyond_corner(const TriangleCorners& p, const TriangleCorners& q) {
  const Vec3& corner = p[0];
  const Segment p_opposite{p[1], p[2]}, q_opposite{q[1], q[2]};
  const bool p_proper = !is_degenerate(p), q_proper = !is_degenerate(q);
  if (p_proper && q_proper)
    return segment_meets_triangle(p_opposite, q) || segment_meets_triangle(q_opposite, p);
  const TriangleCorners& flat = p_proper ? q : p;
  const TriangleCorners& other = p_proper ? p : q;
  for (const Vec3& end : {flat[1], flat[2]}) {
    if (end == corner) continue;
    if (point_on_triangle(end, other)) return true;
    const Segment arm{corner, end};
    if (p_proper || q_proper) {
      if (segments_intersect(arm, {other[1], other[2]})) return true;
    } else {
      for (const Vec3& far : {other[1], other[2]})
        if (far != corner && point_on_segment(far, arm)) return true;
    }
  }
  return false;
}

// A proper triangle meets the line of its edge in that edge alone.
bool meet_beyond_edge(const TriangleCorners& p, const TriangleCorners& q) {
  const Segment edge{p[0], p[1]};
  const bool p_proper = !is_degenerate(p), q_proper = !is_degenerate(q);
  if (p_proper && q_proper) {
    if (orientation(p[0], p[1], p[2], q[2]) != 0) return false;
    const int axis = injective_axis(p[0], p[1], p[2]);
    return same_strict_side(projected_orientation(p[0], p[1], p[2], axis),
                            projected_orientation(p[0], p[1], q[2], axis));
  }
  if (p_proper || q_proper) return false;
  if (point_on_segment(p[2], edge) || point_on_segment(q[2], edge)) return false;
  return point_on_segment(p[2], segment_of_degenerate(q)) ||
         point_on_segment(q[2], segment_of_degenerate(p));
}

bool meet_beyond_shared(const Triangle& p, const TriangleCorners& p_corners, const Triangle& q,
                        const TriangleCorners& q_corners) {
  const SharedCorners shared = shared_corners(p, q);
  if (shared.duplicates) return false;
  const auto arranged = [](const TriangleCorners& t, const std::array<std::uint8_t, 3>& order) {
    return TriangleCorners{t[order[0]], t[order[1]], t[order[2]]};
  };
  const TriangleCorners a = arranged(p_corners, shared.p), b = arranged(q_corners, shared.q);
  return shared.count == 0   ? triangles_intersect(a, b)
         : shared.count == 1 ? meet_beyond_corner(a, b)
                             : meet_beyond_edge(a, b);
}

Segment segment_of_degenerate(const TriangleCorners& t) {
  const auto [low, high] = std::minmax_element(t.begin(), t.end(), lexicographically_less);
  return {*low, *high};
}

}  // namespace contactcheck::oracle
