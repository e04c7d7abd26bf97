// Signs of determinants as single precision sees them: the same determinants as predicates.h, of
// floats, in the same order of operations, none of them fused, and without a filter or an exact
// path behind them. NOT exact: near zero the sign may be any of the three. The same bits on every
// instruction set, so lanes of a vector that keep the order give the same signs.
//
// No overflow and no NaN within kSingleLimit (local_origin.h): differences are at most 2^41, their
// products 2^82, a determinant at most 6 * 2^123. Determinants of differences below 2^-40 metres
// underflow: such triangles are flat, and closed tests then tend to say that they meet.
// @pre |coordinates| at most kSingleLimit
#pragma once

#include "core/types/vec3.h"

namespace contactcheck {

inline int sign_of(float x) { return (x > 0.0f ? 1 : 0) - (x < 0.0f ? 1 : 0); }

/// Sign of det(b - a, c - a, d - a), as orient3d() of doubles says it, plain.
inline int orient3d(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d) {
  const float ux = b.x() - a.x(), uy = b.y() - a.y(), uz = b.z() - a.z();
  const float vx = c.x() - a.x(), vy = c.y() - a.y(), vz = c.z() - a.z();
  const float wx = d.x() - a.x(), wy = d.y() - a.y(), wz = d.z() - a.z();
  return sign_of((uy * vz - uz * vy) * wx + (uz * vx - ux * vz) * wy + (ux * vy - uy * vx) * wz);
}

/// Sign of the area of (a, b, c) projected along `axis`, as orient2d() of doubles says it, plain.
inline int orient2d(const Vec3f& a, const Vec3f& b, const Vec3f& c, int axis) {
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  const float ux = b[first] - a[first], uy = b[second] - a[second];
  const float vx = c[first] - a[first], vy = c[second] - a[second];
  return sign_of(ux * vy - uy * vx);
}

/// All three projected areas are zero by orient2d().
inline bool collinear(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  return orient2d(a, b, c, 0) == 0 && orient2d(a, b, c, 1) == 0 && orient2d(a, b, c, 2) == 0;
}

}  // namespace contactcheck
