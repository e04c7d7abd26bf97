// What the oracle's double arithmetic assumes: the default floating-point environment, and
// coordinates scaled by a power of two to at most 1, where squares and products neither overflow
// nor lose significant digits to underflow.
#pragma once

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>
#include <span>

#include "core/types/vec3.h"

namespace contactcheck::oracle {

/// Sets round to nearest, subnormals kept, no traps; restores the caller's environment at its end.
/// Some libraries leave flush-to-zero set (Embree 3.13, seen in 2026), with which CGAL 5.5 reports
/// false contacts at scale 1e-104.
class FloatingPointGuard {
 public:
  FloatingPointGuard() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~FloatingPointGuard() { std::fesetenv(&saved_); }
  FloatingPointGuard(const FloatingPointGuard&) = delete;
  FloatingPointGuard& operator=(const FloatingPointGuard&) = delete;

 private:
  std::fenv_t saved_;
};

/// The smallest box that contains the points; empty without points.
inline Aabb box_of(std::span<const Vec3> points) {
  Aabb box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

inline double largest_coordinate(std::span<const Vec3> points) {
  double out = 0;
  for (const Vec3& p : points) out = std::max(out, p.cwiseAbs().maxCoeff());
  return out;
}

/// The largest side of the points' box; infinite if it overflows, 0 without points.
inline double largest_side(std::span<const Vec3> points) {
  return points.empty() ? 0.0 : box_of(points).extent().maxCoeff();
}

/// The lowest k with x * 2^-k < 1. 0 and infinity count as the smallest and the largest double.
/// @pre x >= 0
inline int exponent_above(double x) {
  return std::ilogb(std::clamp(x, std::numeric_limits<double>::denorm_min(),
                               std::numeric_limits<double>::max())) +
         1;
}

/// p * 2^k, exact except for bits below 2^-1074.
inline Vec3 scaled_by_two_to(int k, const Vec3& p) {
  return {std::ldexp(p.x(), k), std::ldexp(p.y(), k), std::ldexp(p.z(), k)};
}

}  // namespace contactcheck::oracle
