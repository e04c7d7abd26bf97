// True, reported, missed and spurious contacts, summed over runs.
#pragma once

#include <cstdint>
#include <optional>

#include "reference/results/results.h"

namespace contactcheck::report {

struct ErrorCounts {
  std::uint64_t truth = 0, reported = 0, missed = 0, spurious = 0;

  /// Adds the counts of a run that is `ok`, at this level. False if the level was not judged or the
  /// detector does not claim it.
  bool add(const results::Run& run, std::optional<Level> level);

  /// missed / truth; nothing if there was nothing to find.
  std::optional<double> missed_share() const;
  /// spurious / reported; nothing if nothing was reported.
  std::optional<double> spurious_share() const;
  /// The larger of the two; nothing if neither has a value.
  std::optional<double> worse_share() const;
};

}  // namespace contactcheck::report
