// The winding number is the signed number of crossings of a ray from the point to infinity, for any
// ray in general position. Here the ray runs along +x from the point displaced by (0, e, e^2), e
// infinitely small and positive: then no crossing is degenerate, no second ray is ever needed, and
// the boxes that the ray meets are found by comparisons alone. The displacement does not change the
// answer, for a point that is not on the surface has a neighbourhood free of it.
// Source of the idea: Edelsbrunner & Muecke, Simulation of Simplicity, ACM TOG 1990.
#include "reference/oracle/winding.h"

#include "reference/oracle/exact_tests.h"

namespace contactcheck::oracle {
namespace {

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

}  // namespace contactcheck::oracle
