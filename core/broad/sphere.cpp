#include "core/broad/sphere.h"

#include <algorithm>
#include <cmath>

namespace contactcheck {
double covering_radius(const Vec3& center, std::span<const Vec3> points, double slack) {
  double largest = 0.0;
  for (const Vec3& p : points) largest = std::max(largest, (p - center).squaredNorm());
  return covering_radius(largest, slack);
}

double covering_radius(double largest_squared_distance, double slack) {
  return (std::sqrt(largest_squared_distance) + slack) * kSphereRoundUp + kSphereTiny;
}

}  // namespace contactcheck
