// Bounding spheres, in the two readings of the design: as the paper tests them, and safe.
#pragma once

#include <span>

#include "core/types/vec3.h"

namespace contactcheck {

struct Sphere {
  Vec3 center = Vec3::Zero();
  double radius = 0.0;
};

/// The paper's test: centre distance strictly less than the sum of the radii.
bool collide_strict(const Sphere& a, const Sphere& b);

/// Closed, rounded outward: true whenever the exact closed balls share a point.
bool collide_safe(const Sphere& a, const Sphere& b);

/// The smallest radius about `center` that holds every point, rounded up, plus `slack`: the closed
/// ball holds the exact points moved by at most `slack` each.
double covering_radius(const Vec3& center, std::span<const Vec3> points, double slack);

/// The same from the largest squared distance to a point, as squaredNorm() computes it.
double covering_radius(double largest_squared_distance, double slack);

}  // namespace contactcheck
