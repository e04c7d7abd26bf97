// What a detector found and what it should have found, summed over runs.
#pragma once

#include <cstdint>
#include <optional>

#include "reference/results/results.h"

namespace contactcheck::report {

struct ErrorCounts {
  std::uint64_t truth = 0, reported = 0, missed = 0, spurious = 0;

  /// Adds those of a run that is `ok`, at this level. False where that was not judged or is no
  /// claim of its detector.
  bool add(const results::Run& run, std::optional<Level> level);

  /// missed / truth; nothing where there was nothing to find.
  std::optional<double> missed_share() const;
  /// spurious / reported; nothing where nothing was reported.
  std::optional<double> spurious_share() const;
  /// The larger one; nothing where there is neither.
  std::optional<double> worse_share() const;
};

}  // namespace contactcheck::report
