// Separating axes for a triangle and a box (13 candidates, as in T. Akenine-Moller, "Fast 3D
// triangle-box overlap testing", Journal of Graphics Tools, 2001), decided by exact predicates.
//
// Why 13 axes are enough, for flat boxes and degenerate triangles too. Let B be the box, T the
// triangle and B_s the box grown by s > 0 on all sides. The sum B_s + (-T) is a full-dimensional
// polytope whatever B and T are, and B_s and T are disjoint when the origin lies beyond one of its
// facets. A facet is the sum of a face of B_s and a face of -T whose dimensions add up to at least
// two: its normal is one of the box (3), or orthogonal to an edge of T and to an edge of the box
// (9), or the normal of T (1). B and T are compact, so they are disjoint exactly when B_s and T are
// for some s > 0, and then the gap along one of these axes is positive for B_s, the more so for B.
// An axis that is the zero vector (of a degenerate triangle) separates nothing.
//
// Along an axis of the second kind only the gap behind the edge itself counts (the face of T is
// that edge), so it is enough to know on which side of the edge's line, seen along the box's edge,
// the third corner and the nearest corner of the box lie: signs of orient2d. The triangle's normal
// needs signs of orient3d at two corners of the box. Corners are inputs, never computed.

#include "core/narrow/triangle_box.h"

#include "core/narrow/predicates.h"

namespace contactcheck {
namespace {

/// The corner of the box that is farthest in a direction of which the signs of the components are
/// given; any of the farthest where a component is 0.
Vec3 farthest_corner(const Aabb& box, const std::array<int, 3>& direction) {
  Vec3 corner;
  for (int axis = 0; axis < 3; ++axis)
    corner[axis] = direction[static_cast<std::size_t>(axis)] > 0 ? box.hi[axis] : box.lo[axis];
  return corner;
}

std::array<int, 3> opposite(const std::array<int, 3>& direction) {
  return {-direction[0], -direction[1], -direction[2]};
}

bool separated_by_coordinates(const TrianglePoints& t, const Aabb& box) {
  Aabb own;
  for (const Vec3& corner : t) own.extend(corner);
  return !own.overlaps(box);
}

/// `normal`: signs of the components of (b - a) x (c - a).
bool separated_by_plane(const TrianglePoints& t, const Aabb& box,
                        const std::array<int, 3>& normal) {
  const auto& [a, b, c] = t;
  return orient3d(a, b, c, farthest_corner(box, normal)) < 0 ||
         orient3d(a, b, c, farthest_corner(box, opposite(normal))) > 0;
}

/// Seen along `axis`: the whole box strictly on one side of the line a b, and the triangle's third
/// corner not strictly on that side. `turn`: orient2d of a, b and the third corner.
/// (Where turn is 0 the three edges run forth and back on one line, so both sides get their test.)
bool separated_by_edge(const Vec3& a, const Vec3& b, int turn, const Aabb& box, int axis) {
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  std::array<int, 3> left{};  // signs of the direction to the left of a -> b
  left[static_cast<std::size_t>(first)] = (b[second] < a[second]) - (b[second] > a[second]);
  left[static_cast<std::size_t>(second)] = (b[first] > a[first]) - (b[first] < a[first]);
  if (turn >= 0 && orient2d(a, b, farthest_corner(box, left), axis) < 0) return true;
  return turn <= 0 && orient2d(a, b, farthest_corner(box, opposite(left)), axis) > 0;
}

}  // namespace

bool triangle_meets_box(const TrianglePoints& triangle, const Aabb& box) {
  if (box.empty() || separated_by_coordinates(triangle, box)) return false;
  const auto& [a, b, c] = triangle;
  const std::array<int, 3> normal = {orient2d(a, b, c, 0), orient2d(a, b, c, 1),
                                     orient2d(a, b, c, 2)};
  if (separated_by_plane(triangle, box, normal)) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const int turn = normal[static_cast<std::size_t>(axis)];
    if (separated_by_edge(a, b, turn, box, axis) || separated_by_edge(b, c, turn, box, axis) ||
        separated_by_edge(c, a, turn, box, axis))
      return false;
  }
  return true;
}

}  // namespace contactcheck
