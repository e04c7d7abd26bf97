// Where a detector's answers differ from those before.
#pragma once

#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::results {

/// kOther: neither better nor worse by its numbers, such as other contacts in the same number.
enum class Direction { kWorse, kBetter, kOther };

/// All differences of one row, exactly: status, missed and spurious of each level, geometry,
/// contact hash. One that is worse anywhere is worse.
struct RowChange {
  std::string scene, detector;
  Direction direction = Direction::kOther;
  std::vector<std::string> what;  ///< "triangle missed 0 -> 3"; the most important first
  /// For sorting: a changed status is above all, then the larger change of a count.
  double weight = 0.0;
};

/// Of rows that both have; the most important first. Where the exact truth of a scene is another,
/// counts do not say which is better.
std::vector<RowChange> accuracy_changes(const results::Index& before, const results::Index& after);

}  // namespace contactcheck::results
