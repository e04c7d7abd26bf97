// Pairs of triangles that wait for the exact test, one per SIMD lane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/narrow/triangle_triangle.h"

namespace contactcheck {

inline constexpr std::size_t kBatchWidth = 8;

struct alignas(64) TriangleBatch {
  /// [triangle][corner][axis][lane]: p0 p1 p2 of the first, q0 q1 q2 of the second triangle.
  double corner[2][3][3][kBatchWidth];
  std::uint32_t a[kBatchWidth], b[kBatchWidth];  ///< the caller's names
  std::size_t count = 0;

  TrianglePoints points(int triangle, std::size_t lane) const {
    TrianglePoints out;
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) out[c][k] = corner[triangle][c][k][lane];
    return out;
  }
};

/// Bit i for lane i.
struct BatchVerdict {
  std::uint32_t meet = 0;     ///< certainly share a point
  std::uint32_t unknown = 0;  ///< the filter cannot tell: left to triangles_intersect()
};

}  // namespace contactcheck
