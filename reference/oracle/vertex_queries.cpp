#include "reference/oracle/vertex_queries.h"

#include <numeric>

#include "reference/oracle/exact_tests.h"
#include "reference/oracle/vertex_distance.h"

namespace contactcheck::oracle {
namespace {

// The winding number is the signed number of crossings of a ray from the point to infinity, for any
// ray in general position. Here the ray runs along +x from the point displaced by (0, e, e^2), e
// infinitely small and positive: then no crossing is degenerate, no second ray is ever needed, and
// the boxes that the ray meets are found by comparisons alone. The displacement does not change the
// answer, for a point that is not on the surface has a neighbourhood free of it. Both directions of
// an edge get opposite sides, whoever uses it: sheets that share an edge leave no gap and no
// overlap there, and what cancels in a closed chain cancels in the sum. Source of the idea:
// Edelsbrunner & Muecke, Simulation of Simplicity, ACM TOG 1990.

int sign(double a, double b) { return (a > b) - (a < b); }

// The side of the displaced point (y + e, z + e^2) of the directed edge a -> b, seen against x: the
// sign of (b.y - a.y)(z - a.z) - (b.z - a.z)(y - a.y), then of its derivatives by y and by z. 0
// only when the edge runs along x.
int side_of_displaced(const Vec3& a, const Vec3& b, const Vec3& point) {
  if (const int side = projected_orientation(a, b, point, 0)) return side;
  if (const int by_y = sign(a.z(), b.z())) return by_y;
  return sign(b.y(), a.y());
}

bool ray_meets(const Aabb& box, const Vec3& point) {
  return box.hi.x() >= point.x() && box.lo.y() <= point.y() && point.y() <= box.hi.y() &&
         box.lo.z() <= point.z() && point.z() <= box.hi.z();
}

// +1 when the ray leaves through the triangle, -1 when it enters, 0 when it misses.
// @pre the point is not on the triangle
int crossing(const TriangleCorners& t, const Vec3& point) {
  const int side = side_of_displaced(t[0], t[1], point);
  if (side == 0 || side_of_displaced(t[1], t[2], point) != side ||
      side_of_displaced(t[2], t[0], point) != side) {
    return 0;
  }
  // The line through the point crosses; ahead of it when the point is behind the outgoing side. The
  // orientation is not 0: the closed projection holds the point itself too, so a coplanar point
  // would lie on the triangle.
  return orientation(t[0], t[1], t[2], point) == -side ? side : 0;
}

}  // namespace

std::optional<int> winding_number(const SurfaceTree& surface, const Vec3& point) {
  int winding = 0;
  const bool on_surface = any_triangle(
      surface, [&](const Aabb& box) { return ray_meets(box, point); },
      [&](std::uint32_t triangle) {
        const TriangleCorners corners = surface.corners(triangle);
        if (point.x() >= corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]).x() &&
            point_on_triangle(point, corners)) {
          return true;
        }
        winding += crossing(corners, point);
        return false;
      });
  if (on_surface) return std::nullopt;
  return winding;
}

bool strictly_inside(const SurfaceTree& surface, const Vec3& point) {
  return surface.bounds().contains(point) && winding_number(surface, point).value_or(0) != 0;
}

namespace {

// All vertices go down the tree together; each node passes on those near its box.
//
// Rounding to nearest is monotone: a gap of at most `margin` rounds to at most `margin`, which is a
// double itself. So boxes need no growing: a rounded gap above the margin is a true one.

bool within(double margin, const Vec3& p, const Aabb& box) {
  return box.lo.x() - p.x() <= margin && p.x() - box.hi.x() <= margin &&
         box.lo.y() - p.y() <= margin && p.y() - box.hi.y() <= margin &&
         box.lo.z() - p.z() <= margin && p.z() - box.hi.z() <= margin;
}

}  // namespace

bool boxes_within(double margin, const Aabb& a, const Aabb& b) {
  return ((b.lo - a.hi).array() <= margin).all() && ((a.lo - b.hi).array() <= margin).all();
}

void append_near_pairs(BodyPair pair, std::span<const Vec3> vertices, const SurfaceTree& surface,
                       double margin, std::vector<NearPair>& out) {
  // The vertices passed on, by every node above the present one.
  std::vector<std::uint32_t> passed(vertices.size());
  std::iota(passed.begin(), passed.end(), 0u);

  // Searches below a node for the vertices passed[first .. last).
  const auto descend = [&](const auto& self, std::uint32_t index, std::size_t first,
                           std::size_t last) -> void {
    const SurfaceTree::Node& node = surface.node(index);
    const std::size_t begin = passed.size();
    for (std::size_t i = first; i < last; ++i)
      if (const std::uint32_t v = passed[i]; within(margin, vertices[v], node.box))
        passed.push_back(v);
    const std::size_t end = passed.size();
    if (begin < end && node.is_leaf()) {
      for (std::uint32_t place = node.first; place < node.first + node.count; ++place) {
        const std::uint32_t triangle = surface.triangle_at(place);
        const TriangleCorners corners = surface.corners(triangle);
        for (std::size_t i = begin; i < end; ++i) {
          const Vec3& vertex = vertices[passed[i]];
          if (within(margin, vertex, surface.box_at(place)) && nearer_than(margin, vertex, corners))
            out.push_back({pair.a, pair.b, passed[i], triangle});
        }
      }
    } else if (begin < end) {
      self(self, index + 1, begin, end);
      self(self, node.second, begin, end);
    }
    passed.resize(begin);
  };
  descend(descend, 0, 0, passed.size());
}

}  // namespace contactcheck::oracle
