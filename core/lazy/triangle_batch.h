// Pairs of triangles that wait for their test, one per SIMD lane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/narrow/triangle_triangle.h"

namespace contactcheck {

inline constexpr std::size_t kBatchWidth = 8;

template <class Real>
struct alignas(64) TriangleBatchOf {
  /// [triangle][corner][axis][lane]: p0 p1 p2 of the first, q0 q1 q2 of the second triangle.
  Real corner[2][3][3][kBatchWidth];
  std::uint32_t a[kBatchWidth], b[kBatchWidth];  ///< the caller's names
  std::size_t count = 0;

  TrianglePointsOf<Real> points(int triangle, std::size_t lane) const {
    TrianglePointsOf<Real> out;
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) out[c][k] = corner[triangle][c][k][lane];
    return out;
  }
};
using TriangleBatch = TriangleBatchOf<double>;
using SingleTriangleBatch = TriangleBatchOf<float>;

/// Bit i for lane i.
struct BatchVerdict {
  std::uint32_t meet = 0;     ///< share a point
  std::uint32_t unknown = 0;  ///< the lanes cannot tell: left to triangles_intersect()
};

}  // namespace contactcheck
