// Whether a detector has become faster or slower against a reference that ran beside it.
#pragma once

#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck {

/// Smaller changes are not worth a line.
inline constexpr double kSmallestTimeChange = 0.05;

/// The speed-up over `reference` now divided by the one then: above 1 is faster than before.
struct TimeChange {
  std::string scene, detector, reference;
  Ratio factor;
  std::size_t passes = 0;  ///< the fewer of the two: they tell what the factor's ends are
};

/// Of rows with a speed-up over the same reference in both (the first of the row that is not the
/// detector itself), in playback: those whose whole interval is on one side of 1, and whose factor
/// is further than kSmallestTimeChange from it; a range must lie outside 1 by kRangeFactor. The
/// largest first.
std::vector<TimeChange> time_changes(const results::Index& before, const results::Results& after);

}  // namespace contactcheck
