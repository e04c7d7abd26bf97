// Lengths and directions with the order of additions written down, like fixed_order.h.
#pragma once

#include <cmath>

#include "core/dynamics/fixed_order.h"
#include "core/types/vec3.h"

namespace contactcheck {

inline double ordered_norm(const Vec3& v) { return std::sqrt(ordered_dot(v, v)); }

/// v / |v|, also where the squares of v leave the range of doubles; zero for zero and for a v that
/// is not finite.
inline Vec3 unit_or_zero(const Vec3& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  if (!(largest > 0.0) || !std::isfinite(largest)) return Vec3::Zero();
  const Vec3 scaled = v / largest;
  return scaled / ordered_norm(scaled);
}

}  // namespace contactcheck
