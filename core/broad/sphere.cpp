#include "core/broad/sphere.h"

#include <algorithm>
#include <cmath>

namespace contactcheck {
namespace {

// Relative error of a sum of three squared differences: each difference, square and sum rounds
// once; the square doubles the difference's error: below 5 * 2^-53. With sqrt and the sum of radii
// below 8 * 2^-53 in all; 16 leaves room.
constexpr double kUp = 1.0 + 16.0 * 0x1p-53;
// Covers underflow of the squares (each at most 2^-1075, their root about 2^-537).
constexpr double kTiny = 0x1p-500;

}  // namespace

double covering_radius(const Vec3& center, std::span<const Vec3> points, double slack) {
  double largest = 0.0;
  for (const Vec3& p : points) largest = std::max(largest, (p - center).squaredNorm());
  return covering_radius(largest, slack);
}

double covering_radius(double largest_squared_distance, double slack) {
  return (std::sqrt(largest_squared_distance) + slack) * kUp + kTiny;
}

}  // namespace contactcheck
