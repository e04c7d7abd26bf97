// Signs of determinants, exact for all finite doubles.
//
// Each predicate first evaluates the determinant in doubles and trusts its sign where a proven
// error bound allows (derivation in predicates.cpp), else it computes in exact integers.
// @pre finite coordinates; the processor rounds to nearest and does not flush denormals to zero
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/types/vec3.h"

namespace contactcheck {

/// The error bounds of the filters, relative to the product of the largest differences per axis.
/// Smaller values would make wrong signs possible, larger ones send more calls to exact arithmetic.
inline constexpr double kOrient3dErrorFactor = 48 * 0x1p-53;
inline constexpr double kOrient2dErrorFactor = 10 * 0x1p-53;
/// Outside these limits overflow or underflow could spoil the bounds: the exact path decides. (The
/// largest difference matters to orient3d alone.)
inline constexpr double kFilterLargestDifference = 0x1p300;
inline constexpr double kFilterSmallestBound = 0x1p-700;

/// The exact paths of orient3d and orient2d, without a filter. Slow; they count the call.
int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int orient2d_exact(const Vec3& a, const Vec3& b, const Vec3& c, int axis);

/// Sign of det(b - a, c - a, d - a): +1 when d lies on the side of the plane abc from which a, b, c
/// appear counter-clockwise, 0 when the four points are exactly coplanar.
/// (Equals the sign of CGAL::orientation(a, b, c, d).)
inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double ux = b.x() - a.x(), uy = b.y() - a.y(), uz = b.z() - a.z();
  const double vx = c.x() - a.x(), vy = c.y() - a.y(), vz = c.z() - a.z();
  const double wx = d.x() - a.x(), wy = d.y() - a.y(), wz = d.z() - a.z();
  const double determinant =
      (uy * vz - uz * vy) * wx + (uz * vx - ux * vz) * wy + (ux * vy - uy * vx) * wz;
  const double x = std::max(std::max(std::abs(ux), std::abs(vx)), std::abs(wx));
  const double y = std::max(std::max(std::abs(uy), std::abs(vy)), std::abs(wy));
  const double z = std::max(std::max(std::abs(uz), std::abs(vz)), std::abs(wz));
  const double bound = kOrient3dErrorFactor * (x * y * z);
  if (bound >= kFilterSmallestBound && std::max(std::max(x, y), z) <= kFilterLargestDifference) {
    if (determinant > bound) return 1;
    if (determinant < -bound) return -1;
  }
  if (x == 0 || y == 0 || z == 0) return 0;  // a column of zeros: exactly coplanar
  return orient3d_exact(a, b, c, d);
}

/// Sign of the signed area of (a, b, c) projected along `axis` (0, 1, 2): the coordinates
/// (axis + 1) % 3 and (axis + 2) % 3 remain, in this order. 0 when exactly collinear.
inline int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  const double ux = b[first] - a[first], uy = b[second] - a[second];
  const double vx = c[first] - a[first], vy = c[second] - a[second];
  const double determinant = ux * vy - uy * vx;
  const double x = std::max(std::abs(ux), std::abs(vx));
  const double y = std::max(std::abs(uy), std::abs(vy));
  const double bound = kOrient2dErrorFactor * (x * y);
  if (bound >= kFilterSmallestBound) {
    if (determinant > bound) return 1;
    if (determinant < -bound) return -1;
  }
  if (x == 0 || y == 0) return 0;
  return orient2d_exact(a, b, c, axis);
}

/// True when the three points are exactly collinear (or coincide).
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// How often the exact path was taken in this thread since the last reset (cost counter).
std::size_t exact_predicate_calls();
void reset_exact_predicate_calls();

}  // namespace contactcheck
