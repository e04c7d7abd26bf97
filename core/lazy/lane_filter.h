// When the sign of a determinant on a lane may be trusted.
//
// orient3d is wrong by at most 48 e X Y Z, X, Y, Z the largest |differences| per axis, e the
// rounding error of its numbers: the derivation in narrow/predicates.cpp asks nothing of e but that
// 200 e^2 and 3 e are far below e, which holds for 2^-24 as for 2^-53. What differs in floats is
// where products underflow: each is then wrong by up to n = 2^-150, a determinant by up to
// 3 (2 n max(X, Y, Z) + n) and roundings thereof, below 2^-106 as differences are at most 2^41 (of
// coordinates within kSingleLimit). The bound is at least 2^-99, so e X Y Z, a 48th of it and more
// than 2^-105, covers that. (Underflow within the bound: if fl(X Y) underflowed, the bound would be
// below 2^-126 * 2^41 * 2^-18 and fail its test.) Overflow: no sum is above 6 * 2^123.
#pragma once

#include "core/narrow/predicates.h"

namespace contactcheck {

template <typename Real>
struct LaneFilter;

template <>
struct LaneFilter<double> {
  static constexpr double kErrorFactor = kOrient3dErrorFactor;
  static constexpr double kSmallestBound = kFilterSmallestBound;
  static constexpr double kLargestDifference = kFilterLargestDifference;
};

template <>
struct LaneFilter<float> {
  static constexpr float kErrorFactor = 48 * 0x1p-24f;
  static constexpr float kSmallestBound = 0x1p-99f;
  static constexpr float kLargestDifference = 0x1p41f;
};

}  // namespace contactcheck
