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

/// Relative error of a sum of three squared differences: each difference, square and sum rounds
/// once; the square doubles the difference's error: below 5 * 2^-53. With a root or the square of a
/// sum of radii below 9 * 2^-53 in all; 16 leaves room.
inline constexpr double kSphereRoundUp = 1.0 + 16.0 * 0x1p-53;
/// Covers underflow of the squares (each at most 2^-1075, their root about 2^-537).
inline constexpr double kSphereTiny = 0x1p-500;

/// The paper's test: centre distance strictly less than the sum of the radii, both squared.
inline bool collide_strict(const Sphere& a, const Sphere& b) {
  const double reach = a.radius + b.radius;
  return (a.center - b.center).squaredNorm() < reach * reach;
}

/// Closed, rounded outward: true whenever the exact closed balls share a point.
inline bool collide_safe(const Sphere& a, const Sphere& b) {
  const double reach = (a.radius + b.radius) + kSphereTiny;
  const double distance2 = (a.center - b.center).squaredNorm();
  // Beyond about 1e154 the squares overflow: nothing is known, nothing is excluded.
  return !(distance2 > reach * reach * kSphereRoundUp) ||
         distance2 > std::numeric_limits<double>::max();
}

/// The smallest radius about `center` that holds every point, rounded up, plus `slack`: the closed
/// ball holds the exact points moved by at most `slack` each.
double covering_radius(const Vec3& center, std::span<const Vec3> points, double slack);

/// The same from the largest squared distance to a point, as squaredNorm() computes it.
double covering_radius(double largest_squared_distance, double slack);

}  // namespace contactcheck
