// The exact signs that every verdict of the oracle uses, and its only calls of CGAL's EPICK kernel.
//
// Answers are exact for every finite double, subnormal ones included; all inputs must be finite.
// Source: CGAL 5.5, EPICK kernel (LGPL): floating-point filters, then exact arithmetic. CGAL's own
// checks vanish under NDEBUG, and it then silently answers degenerate triangles wrong (seen in
// 5.5.1), so this file never passes it one.
#pragma once

#include <array>

#include "core/types/vec3.h"

namespace contactcheck::oracle {

/// The three corners of a triangle; a degenerate triangle is treated as a segment or a point.
using TriangleCorners = std::array<Vec3, 3>;

/// Sign of det[b - a, c - a, d - a]: +1 when d lies on the side to which (b - a) x (c - a) points.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of component `axis` of (b - a) x (c - a): the turn a, b, c, seen against that axis.
int projected_orientation(const Vec3& a, const Vec3& b, const Vec3& c, int axis);

/// True when the three points lie on one line (or coincide).
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// Lexicographic order; among collinear points the order along their line.
bool lexicographically_less(const Vec3& a, const Vec3& b);

/// True when the closed triangles share a point.
/// @pre both are proper: no three collinear corners
bool proper_triangles_intersect(const TriangleCorners& p, const TriangleCorners& q);

}  // namespace contactcheck::oracle
