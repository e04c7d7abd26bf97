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
#include "core/narrow/predicates_single.h"
#include "core/narrow/segments.h"

namespace contactcheck {
namespace {

using Sides = std::array<int, 3>;

/// The side of plane(a, b, c) on which each corner of `t` lies.
template <typename T>
Sides sides_of_plane(const TrianglePointsOf<T>& plane, const TrianglePointsOf<T>& t) {
  const auto& [a, b, c] = plane;
  return {orient3d(a, b, c, t[0]), orient3d(a, b, c, t[1]), orient3d(a, b, c, t[2])};
}

bool all_strictly_on_one_side(const Sides& s) { return s[0] != 0 && s[0] == s[1] && s[0] == s[2]; }

bool has_zero(const Sides& s) { return s[0] == 0 || s[1] == 0 || s[2] == 0; }

/// The corner alone on its side. @pre no zero, not all equal
std::size_t lone_corner(const Sides& s) { return s[1] == s[2] ? 0 : (s[0] == s[2] ? 1 : 2); }

/// @pre both triangles strictly straddle the other's plane: p_sides and q_sides hold no zero and
/// both signs. Then both are proper and their planes meet in a line.
template <typename T>
bool straddling_triangles_meet(const TrianglePointsOf<T>& p, const Sides& p_sides,
                               const TrianglePointsOf<T>& q, const Sides& q_sides) {
  const std::size_t i = lone_corner(p_sides), j = lone_corner(q_sides);
  const Vec3Of<T>&p0 = p[i], *p1 = &p[(i + 1) % 3], *p2 = &p[(i + 2) % 3];
  const Vec3Of<T>&q0 = q[j], *q1 = &q[(j + 1) % 3], *q2 = &q[(j + 2) % 3];
  // Turn each triangle so that the other's lone corner lies on its positive side.
  if (p_sides[i] < 0) std::swap(q1, q2);
  if (q_sides[j] < 0) std::swap(p1, p2);
  // p cuts [p0p1, p0p2] out of the common line, q cuts [q0q1, q0q2] in the same direction. They
  // overlap, ends included, when neither begins behind the other's end.
  return orient3d(p0, *p1, q0, *q1) <= 0 && orient3d(p0, *p2, *q2, q0) <= 0;
}

template <typename T>
using ShapeOf = std::variant<Vec3Of<T>, SegmentOf<T>, ProperTriangleOf<T>>;

/// What the triangle really is: a point, the segment from its first to its last corner, or proper.
template <typename T>
ShapeOf<T> shape_of(const TrianglePointsOf<T>& t) {
  for (int axis = 0; axis < 3; ++axis)
    if (orient2d(t[0], t[1], t[2], axis) != 0) return ProperTriangleOf<T>{t, axis};
  const auto [first, last] = std::minmax_element(t.begin(), t.end(), before<T>);
  if (*first == *last) return *first;
  return SegmentOf<T>{*first, *last};
}

template <typename T>
bool an_edge_meets(const ProperTriangleOf<T>& p, const ProperTriangleOf<T>& q) {
  const auto& [a, b, c] = p.corners;
  return segment_meets_triangle(ordered_segment(a, b), q) ||
         segment_meets_triangle(ordered_segment(b, c), q) ||
         segment_meets_triangle(ordered_segment(c, a), q);
}

/// One overload for every pair of shapes.
template <typename T>
struct ShapesMeet {
  bool operator()(const Vec3Of<T>& p, const Vec3Of<T>& q) const { return p == q; }
  bool operator()(const Vec3Of<T>& p, const SegmentOf<T>& q) const {
    return point_on_segment(p, q);
  }
  bool operator()(const Vec3Of<T>& p, const ProperTriangleOf<T>& q) const {
    return point_on_triangle(p, q);
  }
  bool operator()(const SegmentOf<T>& p, const Vec3Of<T>& q) const {
    return point_on_segment(q, p);
  }
  bool operator()(const SegmentOf<T>& p, const SegmentOf<T>& q) const {
    return segments_meet(p, q);
  }
  bool operator()(const SegmentOf<T>& p, const ProperTriangleOf<T>& q) const {
    return segment_meets_triangle(p, q);
  }
  bool operator()(const ProperTriangleOf<T>& p, const Vec3Of<T>& q) const {
    return point_on_triangle(q, p);
  }
  bool operator()(const ProperTriangleOf<T>& p, const SegmentOf<T>& q) const {
    return segment_meets_triangle(q, p);
  }
  /// The common part of two triangles is convex, and its extreme points lie on edges.
  bool operator()(const ProperTriangleOf<T>& p, const ProperTriangleOf<T>& q) const {
    return an_edge_meets(p, q) || an_edge_meets(q, p);
  }
};

template <typename T>
bool boxes_overlap(const TrianglePointsOf<T>& p, const TrianglePointsOf<T>& q) {
  AabbOf<T> p_box, q_box;
  for (const Vec3Of<T>& corner : p) p_box.extend(corner);
  for (const Vec3Of<T>& corner : q) q_box.extend(corner);
  return p_box.overlaps(q_box);
}

template <typename T>
bool special_triangles_meet(const TrianglePointsOf<T>& p, const TrianglePointsOf<T>& q) {
  // In doubles it saves exact arithmetic and decides nothing else.
  if (!boxes_overlap(p, q)) return false;
  return std::visit(ShapesMeet<T>{}, shape_of(p), shape_of(q));
}

// Meshes that coincide or were cut from one another meet in corners most of all, and there every
// sign would need exact arithmetic.
template <typename T>
bool share_a_corner(const TrianglePointsOf<T>& p, const TrianglePointsOf<T>& q) {
  for (const Vec3Of<T>& a : p)
    for (const Vec3Of<T>& b : q)
      if (a.x() == b.x() && a.y() == b.y() && a.z() == b.z()) return true;
  return false;
}

template <typename T>
bool triangles_meet(const TrianglePointsOf<T>& p, const TrianglePointsOf<T>& q) {
  if (share_a_corner(p, q)) return true;
  const Sides q_sides = sides_of_plane(p, q);
  if (all_strictly_on_one_side(q_sides)) return false;
  const Sides p_sides = sides_of_plane(q, p);
  if (all_strictly_on_one_side(p_sides)) return false;
  if (has_zero(p_sides) || has_zero(q_sides)) return special_triangles_meet(p, q);
  return straddling_triangles_meet(p, p_sides, q, q_sides);
}

}  // namespace

bool triangles_intersect(const TrianglePoints& p, const TrianglePoints& q) {
  return triangles_meet(p, q);
}

bool triangles_intersect(const TrianglePointsOf<float>& p, const TrianglePointsOf<float>& q) {
  return triangles_meet(p, q);
}

}  // namespace contactcheck
