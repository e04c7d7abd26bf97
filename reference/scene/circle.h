// Points on the unit circle without libm, so that built-in shapes have the same bits everywhere:
// glibc's sin and cos differ between processors with and without fused multiply-add.
#pragma once

#include <cstddef>

namespace contactcheck {

struct CirclePoint {
  double cosine = 1.0, sine = 0.0;
};

/// The point at `k` of `n` equal steps round the circle, within 2^-51 of the exact one; exact at
/// the quarters, and symmetric about both axes and both diagonals.
/// @pre n > 0
CirclePoint circle_point(std::size_t k, std::size_t n);

}  // namespace contactcheck
