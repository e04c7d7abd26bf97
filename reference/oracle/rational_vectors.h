// Points with rational coordinates.
#pragma once

#include <gmpxx.h>

#include <array>

#include "core/types/vec3.h"

namespace contactcheck::oracle::rational {

using Point = std::array<mpq_class, 3>;
using PointTriple = std::array<Point, 3>;     ///< corners of a triangle
using TriangleCorners = std::array<Vec3, 3>;  ///< the same type as core's TrianglePoints

/// Every finite double is a rational.
inline Point to_rational(const Vec3& p) {
  return {mpq_class(p.x()), mpq_class(p.y()), mpq_class(p.z())};
}

inline PointTriple to_rational(const TriangleCorners& t) {
  return {to_rational(t[0]), to_rational(t[1]), to_rational(t[2])};
}

inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline mpq_class dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace contactcheck::oracle::rational
