// The generic case, where no vertex of one triangle lies in the plane of the other, follows
// P. Guigue and O. Devillers, "Fast and robust triangle-triangle overlap test using orientation
// predicates", Journal of Graphics Tools, 2003: the two triangles cut intervals out of the line
// common to both planes, and two signs say whether the intervals overlap. All other cases
// (touching, coplanar, degenerate) go to a separate path over edges.

#include "core/narrow/triangle_triangle.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "core/narrow/predicates.h"
#include "core/narrow/segments.h"

namespace contactcheck {
namespace {

using Sides = std::array<int, 3>;

/// The side of plane(a, b, c) on which each corner of `t` lies.
Sides sides_of_plane(const TrianglePoints& plane, const TrianglePoints& t) {
  const auto& [a, b, c] = plane;
  return {orient3d(a, b, c, t[0]), orient3d(a, b, c, t[1]), orient3d(a, b, c, t[2])};
}

bool all_strictly_on_one_side(const Sides& s) { return s[0] != 0 && s[0] == s[1] && s[0] == s[2]; }

bool has_zero(const Sides& s) { return s[0] == 0 || s[1] == 0 || s[2] == 0; }

/// The corner alone on its side. @pre no zero, not all equal
std::size_t lone_corner(const Sides& s) { return s[1] == s[2] ? 0 : (s[0] == s[2] ? 1 : 2); }

/// @pre both triangles strictly straddle the other's plane: p_sides and q_sides hold no zero and
/// both signs. Then both are proper and their planes meet in a line.
bool straddling_triangles_meet(const TrianglePoints& p, const Sides& p_sides,
                               const TrianglePoints& q, const Sides& q_sides) {
  const std::size_t i = lone_corner(p_sides), j = lone_corner(q_sides);
  const Vec3 &p0 = p[i], *p1 = &p[(i + 1) % 3], *p2 = &p[(i + 2) % 3];
  const Vec3 &q0 = q[j], *q1 = &q[(j + 1) % 3], *q2 = &q[(j + 2) % 3];
  // Turn each triangle so that the other's lone corner lies on its positive side.
  if (p_sides[i] < 0) std::swap(q1, q2);
  if (q_sides[j] < 0) std::swap(p1, p2);
  // p cuts [p0p1, p0p2] out of the common line, q cuts [q0q1, q0q2] in the same direction. They
  // overlap, ends included, when neither begins behind the other's end.
  return orient3d(p0, *p1, q0, *q1) <= 0 && orient3d(p0, *p2, *q2, q0) <= 0;
}

using Shape = std::variant<Vec3, Segment, ProperTriangle>;

/// What the triangle really is: a point, the segment from its first to its last corner, or proper.
Shape shape_of(const TrianglePoints& t) {
  if (const int axis = projection_axis(t[0], t[1], t[2]); axis >= 0) return ProperTriangle{t, axis};
  const auto [first, last] = std::minmax_element(t.begin(), t.end(), before);
  if (*first == *last) return *first;
  return Segment{*first, *last};
}

bool an_edge_meets(const ProperTriangle& p, const ProperTriangle& q) {
  const auto& [a, b, c] = p.corners;
  return segment_meets_triangle(ordered_segment(a, b), q) ||
         segment_meets_triangle(ordered_segment(b, c), q) ||
         segment_meets_triangle(ordered_segment(c, a), q);
}

/// One overload for every pair of shapes.
struct ShapesMeet {
  bool operator()(const Vec3& p, const Vec3& q) const { return p == q; }
  bool operator()(const Vec3& p, const Segment& q) const { return point_on_segment(p, q); }
  bool operator()(const Vec3& p, const ProperTriangle& q) const { return point_on_triangle(p, q); }
  bool operator()(const Segment& p, const Vec3& q) const { return point_on_segment(q, p); }
  bool operator()(const Segment& p, const Segment& q) const { return segments_meet(p, q); }
  bool operator()(const Segment& p, const ProperTriangle& q) const {
    return segment_meets_triangle(p, q);
  }
  bool operator()(const ProperTriangle& p, const Vec3& q) const { return point_on_triangle(q, p); }
  bool operator()(const ProperTriangle& p, const Segment& q) const {
    return segment_meets_triangle(q, p);
  }
  /// The common part of two triangles is convex, and its extreme points lie on edges.
  bool operator()(const ProperTriangle& p, const ProperTriangle& q) const {
    return an_edge_meets(p, q) || an_edge_meets(q, p);
  }
};

bool boxes_overlap(const TrianglePoints& p, const TrianglePoints& q) {
  Aabb p_box, q_box;
  for (const Vec3& corner : p) p_box.extend(corner);
  for (const Vec3& corner : q) q_box.extend(corner);
  return p_box.overlaps(q_box);
}

bool special_triangles_meet(const TrianglePoints& p, const TrianglePoints& q) {
  if (!boxes_overlap(p, q)) return false;  // saves exact arithmetic, decides nothing else
  return std::visit(ShapesMeet{}, shape_of(p), shape_of(q));
}

// Meshes that coincide or were cut from one another meet in corners most of all, and there every
// sign would need exact arithmetic.
bool share_a_corner(const TrianglePoints& p, const TrianglePoints& q) {
  for (const Vec3& a : p)
    for (const Vec3& b : q)
      if (a.x() == b.x() && a.y() == b.y() && a.z() == b.z()) return true;
  return false;
}

}  // namespace

bool triangles_intersect(const TrianglePoints& p, const TrianglePoints& q) {
  if (share_a_corner(p, q)) return true;
  const Sides q_sides = sides_of_plane(p, q);
  if (all_strictly_on_one_side(q_sides)) return false;
  const Sides p_sides = sides_of_plane(q, p);
  if (all_strictly_on_one_side(p_sides)) return false;
  if (has_zero(p_sides) || has_zero(q_sides)) return special_triangles_meet(p, q);
  return straddling_triangles_meet(p, p_sides, q, q_sides);
}

}  // namespace contactcheck
