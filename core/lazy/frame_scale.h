// How a body's frame is scaled, and how far its float bounds are moved outward.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace contactcheck {

/// The power of two that brings x to about 1 (at most 1), as near as it and its inverse are
/// doubles; 1 for 0.
inline double scale_to_one(double x) {
  constexpr int kLargestExponent = 1000;
  if (!(x > 0.0)) return 1.0;
  int exponent = 0;
  std::frexp(x, &exponent);
  return std::ldexp(1.0, -std::clamp(exponent, -kLargestExponent, kLargestExponent));
}

/// A slack as a float that is no smaller. Finite whatever happens, so that boxes of lanes without a
/// child stay empty; all content of a body lies within 1 of its origin, so this much is everything.
inline float round_up(double slack) {
  constexpr double kEverything = 1e29;
  return std::nextafter(static_cast<float>(std::min(slack, kEverything)),
                        std::numeric_limits<float>::infinity());
}

}  // namespace contactcheck
