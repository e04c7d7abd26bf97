#include "core/broad/sphere.h"

#include <algorithm>

namespace contactcheck {
double covering_radius(const Vec3& center, std::span<const Vec3> points, double slack) {
  double largest = 0.0;
  for (const Vec3& p : points) largest = std::max(largest, squared_distance<double>(p, center));
  return covering_radius(largest, slack);
}

}  // namespace contactcheck
