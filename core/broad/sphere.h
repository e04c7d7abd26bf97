// Bounding spheres, in the two readings of the design: as the paper tests them, and safe.
#pragma once

#include <limits>
#include <span>

#include "core/types/vec3.h"

namespace contactcheck {

struct Sphere {
  Vec3 center = Vec3::Zero();
  double radius = 0.0;
};

/// The paper's test: centre distance strictly less than the sum of the radii, both squared.
inline bool collide_strict(const Sphere& a, const Sphere& b) {
  const double reach = a.radius + b.radius;
  return (a.center - b.center).squaredNorm() < reach * reach;
}

/// Closed, rounded outward: true whenever the exact closed balls share a point.
inline bool collide_safe(const Sphere& a, const Sphere& b) {
  // A sum of three squared differences is off by less than 5 * 2^-53 of itself (each difference,
  // square and sum rounds once; the square doubles the difference's error), the square of the reach
  // by less than 4: 16 leaves room. The smallest reach covers underflow of the squares.
  constexpr double kUp = 1.0 + 16.0 * 0x1p-53;
  constexpr double kTiny = 0x1p-500;
  const double reach = (a.radius + b.radius) + kTiny;
  const double distance2 = (a.center - b.center).squaredNorm();
  // Beyond about 1e154 the squares overflow: nothing is known, nothing is excluded.
  return !(distance2 > reach * reach * kUp) || distance2 > std::numeric_limits<double>::max();
}

/// The smallest radius about `center` that holds every point, rounded up, plus `slack`: the closed
/// ball holds the exact points moved by at most `slack` each.
double covering_radius(const Vec3& center, std::span<const Vec3> points, double slack);

/// The same from the largest squared distance to a point, as squaredNorm() computes it.
double covering_radius(double largest_squared_distance, double slack);

}  // namespace contactcheck
