// Sums of three products whose order of additions is written down: Eigen's own depends on the
// scalar and the instruction set, and verdicts must not.
#pragma once

#include "core/types/vec3.h"

namespace contactcheck {

/// (a.x b.x + a.y b.y) + a.z b.z
template <typename T>
T ordered_dot(const Vec3Of<T>& a, const Vec3Of<T>& b) {
  return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

/// Squared distance of two points, summed in this order.
template <typename T>
T squared_distance(const Vec3Of<T>& a, const Vec3Of<T>& b) {
  const Vec3Of<T> arm = a - b;
  return ordered_dot<T>(arm, arm);
}

}  // namespace contactcheck
