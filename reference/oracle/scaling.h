// Powers of two that bring coordinates to at most 1, where squares and products neither overflow
// nor lose what matters to underflow.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/types/vec3.h"
#include "reference/oracle/point_box.h"

namespace contactcheck::oracle {

inline double largest_coordinate(std::span<const Vec3> points) {
  double out = 0;
  for (const Vec3& p : points) out = std::max(out, p.cwiseAbs().maxCoeff());
  return out;
}

/// The largest side of the points' box; infinite where it overflows, 0 without points.
inline double largest_side(std::span<const Vec3> points) {
  return points.empty() ? 0.0 : box_of(points).extent().maxCoeff();
}

/// The lowest k with x * 2^-k < 1; of 0 and infinity, that of the smallest and largest double.
/// @pre x >= 0
inline int exponent_above(double x) {
  return std::ilogb(std::clamp(x, std::numeric_limits<double>::denorm_min(),
                               std::numeric_limits<double>::max())) +
         1;
}

/// p * 2^k. Exact, but for bits that fall below 2^-1074.
inline Vec3 scaled_by_two_to(int k, const Vec3& p) {
  return {std::ldexp(p.x(), k), std::ldexp(p.y(), k), std::ldexp(p.z(), k)};
}

}  // namespace contactcheck::oracle
