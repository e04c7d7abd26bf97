// How near moving elements come within a step: the certified smallest distance of a vertex and a
// triangle, or of two edges, that do not meet.
//
// It judges a detector's report of contact where there is none: within the tolerance that the
// detector declares, or beyond it.
#pragma once

#include <cstdint>

#include "core/types/impact.h"

namespace contactcheck::oracle {

enum class NearVerdict : std::uint8_t {
  kNear,       ///< the smallest distance is at most the tolerance
  kSpurious,   ///< it is greater
  kUndecided,  ///< subdivision ended first
};

/// The step is cut into at most this many pieces, into fewer where coordinates use most of the
/// range of doubles. Ordinary queries need about 10, and 70 where the distance is 1e-17 of the
/// elements' size. An exact tie at a time that is not dyadic would need infinitely many, of which
/// every second one adds a digit to all times: this many take 30 ms.
inline constexpr int kMostPieces = 800;

struct NearMiss {
  NearVerdict verdict = NearVerdict::kUndecided;
  /// at_least <= smallest distance over [0, 1] <= at_most, metres. Rounded outwards to the next
  /// doubles; at_most is infinite beyond the largest one. Before rounding, they differ by at most
  /// 2^-10 of at_least, or at_most is at most 2^-10 of the tolerance, unless subdivision ended
  /// first.
  double at_least = 0, at_most = 0;
};

/// Exact comparisons, for all finite doubles: a distance that equals the tolerance is near.
/// Elements that do not move relative to each other are never undecided.
/// @pre finite coordinates, no contact within the step
/// @throws std::invalid_argument if a tolerance is negative, infinite or NaN
NearMiss near_miss(const ImpactQuery& query, const ImpactTolerance& tolerance);

}  // namespace contactcheck::oracle
