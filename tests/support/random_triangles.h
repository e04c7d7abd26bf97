// Seeded triangles and boxes for tests: generic, highly degenerate, and off by single ulps.
//
// Only the raw 64-bit output of mt19937_64 is used, which the standard fixes: the same cases on
// every machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "core/narrow/triangle_triangle.h"
#include "core/types/vec3.h"

namespace contactcheck::test {

class TriangleSource {
 public:
  explicit TriangleSource(std::uint64_t seed) : random_(seed) {}

  /// Uniform in 0 .. count - 1 (up to a bias of count / 2^64).
  int below(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }
  /// Uniform in [-1, 1).
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-52 - 1.0; }

  Vec3 point(const Vec3& center, double radius) {
    const double x = unit(), y = unit(), z = unit();
    return center + radius * Vec3(x, y, z);
  }
  TrianglePoints triangle(const Vec3& center, double radius) {
    return {point(center, radius), point(center, radius), point(center, radius)};
  }

  /// Integer coordinates -limit .. limit: equal corners, collinear and coplanar ones are common.
  Vec3 grid_point(int limit) {
    const double x = below(2 * limit + 1) - limit, y = below(2 * limit + 1) - limit;
    return {x, y, static_cast<double>(below(2 * limit + 1) - limit)};
  }
  TrianglePoints grid_triangle(int limit) {
    return {grid_point(limit), grid_point(limit), grid_point(limit)};
  }
  /// A closed box between two grid points; flat in an axis in which they agree.
  Aabb grid_box(int limit) {
    Aabb box;
    box.extend(grid_point(limit));
    box.extend(grid_point(limit));
    return box;
  }
  Aabb box(const Vec3& center, double radius) {
    Aabb result;
    result.extend(point(center, radius));
    result.extend(point(center, radius));
    return result;
  }

  /// Every coordinate moved by -1, 0 or +1 unit in the last place.
  Vec3 jitter(Vec3 p) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const int step = below(3) - 1;
      if (step != 0) p[axis] = std::nextafter(p[axis], step * kInfinity);
    }
    return p;
  }
  /// A point that is, up to rounding, on a corner, on the line of an edge, or in the plane of `t`,
  /// moved by single ulps half of the time.
  Vec3 point_near_feature(const TrianglePoints& t) {
    const auto first = static_cast<std::size_t>(below(3));
    const Vec3 &a = t[first], &b = t[(first + 1) % 3], &c = t[(first + 2) % 3];
    const int kind = below(3);
    const double s = kind > 0 ? 0.25 * (below(7) - 1) : 0.0, r = kind > 1 ? unit() : 0.0;
    const Vec3 p = a + s * (b - a) + r * (c - a);
    return below(2) == 0 ? p : jitter(p);
  }
  /// A triangle of which one to three corners are near features of `t`, the others free.
  TrianglePoints near_degenerate_partner(const TrianglePoints& t, double radius) {
    TrianglePoints result = triangle(t[0], radius);
    const int count = 1 + below(3);
    for (int i = 0; i < count; ++i) result[static_cast<std::size_t>(i)] = point_near_feature(t);
    return result;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace contactcheck::test
