// Differences between a detector's answers and those of an earlier run.
#pragma once

#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::results {

/// kOther: neither better nor worse by its numbers, such as different contacts of the same number.
enum class Direction { kWorse, kBetter, kOther };

/// All exact differences of one row: status, missed and spurious of each level, geometry, contact
/// hash. The row is worse if any of them is worse.
struct RowChange {
  std::string scene, detector;
  Direction direction = Direction::kOther;
  std::vector<std::string> what;  ///< "triangle missed 0 -> 3"; the most important first
  /// For sorting: a changed status comes first, then the larger change of a count.
  double weight = 0.0;
};

/// The changes of rows that both have, the most important first. If the exact ground truth of a
/// scene differs, counts do not say which is better.
std::vector<RowChange> accuracy_changes(const results::Index& before, const results::Index& after);

}  // namespace contactcheck::results
