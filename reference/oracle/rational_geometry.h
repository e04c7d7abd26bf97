// Slow, exact answers in rational arithmetic (GMP), to check the fast ones.
//
// Independent on purpose: an intersection is a linear program over barycentric coordinates, solved
// by the simplex method with Bland's rule, so that touching, coplanar and degenerate input needs no
// special case. Nothing here calls core's predicates. @pre all coordinates finite
#pragma once

#include <gmpxx.h>

#include <array>
#include <vector>

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

/// An equation: the coefficients of all unknowns, and the right-hand side.
struct Equation {
  std::vector<mpq_class> coefficients;
  mpq_class right;
};

/// True when the equations have a solution without a negative unknown. Exact: phase one of the
/// simplex method, which cannot cycle under Bland's rule.
/// @pre every equation has the same number of coefficients
bool has_nonnegative_solution(std::vector<Equation> equations);

/// The sign that the predicates of core/narrow/predicates.h promise.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis);

/// True when the closed triangles share a point; degenerate ones are segments or points.
bool triangles_intersect(const TriangleCorners& p, const TriangleCorners& q);

/// True when the closed triangle and the closed box share a point; an empty box shares none.
bool triangle_meets_box(const TriangleCorners& triangle, const Aabb& box);

/// Exact squared distance in square metres; 0 exactly when the closed triangles share a point.
mpq_class squared_distance(const TriangleCorners& p, const TriangleCorners& q);

}  // namespace contactcheck::oracle::rational
