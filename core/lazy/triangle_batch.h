// Pairs of triangles that wait for their test, one per SIMD lane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/narrow/adjacent_triangles.h"

namespace contactcheck {

inline constexpr std::size_t kBatchWidth = 8;

template <class Real>
struct alignas(64) TriangleBatchOf {
  /// [triangle][corner][axis][lane]: p0 p1 p2 of the first, q0 q1 q2 of the second triangle.
  Real corner[2][3][3][kBatchWidth];
  std::uint32_t a[kBatchWidth], b[kBatchWidth];  ///< the caller's names
  std::size_t count = 0;
  /// How many corners, the first in both, the triangles of each pair share: 0, 1 or 2. With some,
  /// pairs meet where they have a point beyond these in common (meet_beyond_shared).
  std::uint32_t shared = 0;

  TrianglePointsOf<Real> points(int triangle, std::size_t lane) const {
    TrianglePointsOf<Real> out;
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) out[c][k] = corner[triangle][c][k][lane];
    return out;
  }
  /// Tests one pair exactly.
  bool meets(std::size_t lane) const {
    SharedCorners first;
    first.count = shared;
    return meet_beyond_shared(first, points(0, lane), points(1, lane));
  }
};
/// One batch per number of shared corners: 0, 1, 2.
template <class Real>
struct TriangleBatchSet {
  TriangleBatchOf<Real> of[3] = {};
  TriangleBatchSet() {
    for (std::uint32_t shared = 0; shared < 3; ++shared) of[shared].shared = shared;
  }
};
using TriangleBatch = TriangleBatchOf<double>;
using SingleTriangleBatch = TriangleBatchOf<float>;

/// The result of a filtered test; bit i is lane i.
struct BatchVerdict {
  std::uint32_t meet = 0;     ///< share a point (beyond shared corners)
  std::uint32_t unknown = 0;  ///< undecided by the filter: left to TriangleBatchOf::meets()
};

}  // namespace contactcheck
