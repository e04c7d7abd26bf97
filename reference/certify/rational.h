// Points with rational coordinates. For the .cpp files of this layer alone: GMP stays in them.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>

#include "core/types/vec3.h"
#include "reference/oracle/exact_predicates.h"

namespace contactcheck::certify {

using RationalPoint = std::array<mpq_class, 3>;
using RationalTriangle = std::array<RationalPoint, 3>;

/// Every finite double is a rational.
inline RationalPoint to_rational(const Vec3& p) {
  return {mpq_class(p.x()), mpq_class(p.y()), mpq_class(p.z())};
}

inline RationalTriangle to_rational(const oracle::TriangleCorners& t) {
  return {to_rational(t[0]), to_rational(t[1]), to_rational(t[2])};
}

inline RationalPoint operator-(const RationalPoint& a, const RationalPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline mpq_class dot(const RationalPoint& a, const RationalPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline RationalPoint cross(const RationalPoint& a, const RationalPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace contactcheck::certify
