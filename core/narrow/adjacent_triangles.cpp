// Claim: let p = (c, p1, p2) and q = (c, q1, q2) be triangles whose other corners lie strictly on
// both sides of the other's plane. They share a point other than c exactly when p2 lies on the side
// of plane(c, q1, q2) that has the sign of orient3d(c, p1, p2, q1).
//
// 1. The planes meet in a line through c. It leaves p through the edge p1 p2 at a point x, and q
//    through q1 q2 at a point y, neither of them c. Both triangles hold the segment from c to their
//    point, so they share more than c exactly when x and y lie on the same side of c.
// 2. The line runs between q1 and q2, so x lies on y's side exactly when x and q2 lie on one side
//    of the line c q1 in the plane of q.
// 3. p1 p2 crosses that plane at x, and orient3d(p1, p2, c, q1) says on which side of c q1: for
//    c = 0, q1 = (1, 0, 0), q2 = (0, 1, 0), x = (0.3, 0.3, 0), p2 - p1 = (0, 0, 2) it is positive,
//    as the side of p2 is. Each changes its sign with p1 <-> p2 and with the side of x alone.
// 4. orient3d(p1, p2, c, q1) = orient3d(c, p1, p2, q1): an even permutation.

#include "core/narrow/adjacent_triangles.h"

#include <tuple>

#include "core/narrow/predicates.h"
#include "core/narrow/segments.h"

namespace contactcheck {
namespace {

/// On one ray from c? False where one of them is c.
bool same_direction(const Vec3& c, const Vec3& e, const Vec3& f) {
  return e != c && f != c && before(c, e) == before(c, f) && collinear(c, e, f);
}

/// Is some point of the segment c e other than c on the triangle (c, q1, q2)? Near c the triangle
/// is the cone that its two edges span, so e alone decides.
bool leads_into(const Vec3& c, const Vec3& e, const Vec3& q1, const Vec3& q2) {
  const int axis = projection_axis(c, q1, q2);
  if (axis < 0) return same_direction(c, e, q1) || same_direction(c, e, q2);
  if (e == c || orient3d(c, q1, q2, e) != 0) return false;
  const int turn = orient2d(c, q1, q2, axis);
  return orient2d(c, q1, e, axis) * turn >= 0 && orient2d(c, e, q2, axis) * turn >= 0;
}

}  // namespace

bool meet_beyond_corner(const Vec3& c, const Vec3& p1, const Vec3& p2, const Vec3& q1,
                        const Vec3& q2) {
  const int p1_side = orient3d(c, q1, q2, p1), p2_side = orient3d(c, q1, q2, p2);
  if (p1_side * p2_side > 0) return false;
  const int q1_side = orient3d(c, p1, p2, q1), q2_side = orient3d(c, p1, p2, q2);
  if (q1_side * q2_side > 0) return false;
  if (p1_side * p2_side < 0 && q1_side * q2_side < 0) return q1_side == p2_side;
  // Touching, coplanar or degenerate. A further common point gives a ray from c that begins in
  // both: in two cones of which neither crosses the other, along an edge of one of them.
  return leads_into(c, p1, q1, q2) || leads_into(c, p2, q1, q2) || leads_into(c, q1, p1, p2) ||
         leads_into(c, q2, p1, p2);
}

bool meet_beyond_edge(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
  if (orient3d(a, b, p, q) != 0) return false;
  if (a == b) return same_direction(a, p, q);
  const int axis_p = projection_axis(a, b, p), axis_q = projection_axis(a, b, q);
  if (axis_p >= 0 && axis_q >= 0) return orient2d(a, b, p, axis_p) * orient2d(a, b, q, axis_p) > 0;
  // A proper triangle meets the line of its edge in the edge alone.
  if (axis_p >= 0 || axis_q >= 0) return false;
  const Segment edge = ordered_segment(a, b);
  return (before(p, edge.from) && before(q, edge.from)) ||
         (before(edge.to, p) && before(edge.to, q));
}

bool meet_beyond_shared(const SharedCorners& shared, const TrianglePoints& p,
                        const TrianglePoints& q) {
  const auto& [i, j] = std::tie(shared.p, shared.q);
  if (shared.duplicates) return false;
  if (shared.count == 0) return triangles_intersect(p, q);
  if (shared.count == 1) return meet_beyond_corner(p[i[0]], p[i[1]], p[i[2]], q[j[1]], q[j[2]]);
  return meet_beyond_edge(p[i[0]], p[i[1]], p[i[2]], q[j[2]]);
}

}  // namespace contactcheck
