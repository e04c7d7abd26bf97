// Bounding spheres in two readings: as the paper tests them, and safe.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/types/ordered_dot.h"
#include "core/types/vec3.h"

namespace contactcheck {

template <typename T>
struct SphereOf {
  Vec3Of<T> center = Vec3Of<T>::Zero();
  T radius = 0;
};
using Sphere = SphereOf<double>;

/// Relative error of a sum of three squared differences, with u = 2^-53 (of floats 2^-24):
///   * A difference rounds by u. Its square doubles that and rounds by u: 3 u.
///   * Two sums round by u each: 5 u to first order.
///   * With a root, or with the square of a sum of radii, below 9 u in all. 16 u leaves room.
template <typename T>
inline constexpr T kSphereRoundUp = 1 + 16 * (std::numeric_limits<T>::epsilon() / 2);
/// Covers underflow of the squares, each by at most 2^-1075 with a root of about 2^-537 (of floats
/// 2^-150 and 2^-75). Its own square does not underflow.
template <typename T>
inline constexpr T kSphereTiny = static_cast<T>(sizeof(T) == sizeof(float) ? 0x1p-60 : 0x1p-500);

/// The paper's test: centre distance strictly less than the sum of the radii, both squared.
template <typename T>
bool collide_strict(const SphereOf<T>& a, const SphereOf<T>& b) {
  const T reach = a.radius + b.radius;
  return squared_distance<T>(a.center, b.center) < reach * reach;
}

/// Closed, rounded outward: true whenever the exact closed balls share a point.
template <typename T>
bool collide_safe(const SphereOf<T>& a, const SphereOf<T>& b) {
  const T reach = (a.radius + b.radius) + kSphereTiny<T>;
  const T distance2 = squared_distance<T>(a.center, b.center);
  // Squares overflow beyond about 1e154 (of floats 1e19): then no pair is excluded.
  return !(distance2 > reach * reach * kSphereRoundUp<T>) ||
         distance2 > std::numeric_limits<T>::max();
}

/// The radius of a ball that contains points moved by at most `slack` each, rounded up, from the
/// largest squared distance of a point to its centre as squared_distance() computes it.
template <typename T>
T covering_radius(T largest_squared_distance, T slack) {
  return (std::sqrt(largest_squared_distance) + slack) * kSphereRoundUp<T> + kSphereTiny<T>;
}

/// The same for `points`: the closed ball contains the exact points moved by at most `slack` each.
inline double covering_radius(const Vec3& center, std::span<const Vec3> points, double slack) {
  double largest = 0.0;
  for (const Vec3& p : points) largest = std::max(largest, squared_distance<double>(p, center));
  return covering_radius(largest, slack);
}

}  // namespace contactcheck
