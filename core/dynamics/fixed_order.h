// Products of 3-vectors and 3x3 matrices whose order of additions is written down: Eigen's own
// depends on the instruction set it was compiled for, and a simulated trajectory must not.
#pragma once

#include <Eigen/Core>

#include "core/types/ordered_dot.h"
#include "core/types/vec3.h"

namespace contactcheck {

using Mat3 = Eigen::Matrix3d;

// Accepts columns of matrices, too.
inline double ordered_dot(const Vec3& a, const Vec3& b) { return ordered_dot<double>(a, b); }

/// m * v
inline Vec3 ordered_product(const Mat3& m, const Vec3& v) {
  return m.col(0) * v.x() + m.col(1) * v.y() + m.col(2) * v.z();
}

/// m^T * v
inline Vec3 transposed_product(const Mat3& m, const Vec3& v) {
  return {ordered_dot(m.col(0), v), ordered_dot(m.col(1), v), ordered_dot(m.col(2), v)};
}

/// a^T * b
inline Mat3 transposed_product(const Mat3& a, const Mat3& b) {
  Mat3 out;
  for (int k = 0; k < 3; ++k) out.col(k) = transposed_product(a, Vec3(b.col(k)));
  return out;
}

/// Adds scale * v * w^T to m.
inline void add_outer(Mat3& m, double scale, const Vec3& v, const Vec3& w) {
  for (int k = 0; k < 3; ++k) m.col(k) += v * (scale * w[k]);
}

/// The cofactors of m: its inverse transposed, times its determinant.
inline Mat3 cofactors(const Mat3& m) {
  const Vec3 x = m.col(0), y = m.col(1), z = m.col(2);
  Mat3 out;
  out << y.cross(z), z.cross(x), x.cross(y);
  return out;
}

}  // namespace contactcheck
