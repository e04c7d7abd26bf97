// Two results side by side: what got worse, better, new and gone.
#pragma once

#include <string>
#include <vector>

#include "reference/diff/accuracy_changes.h"
#include "reference/diff/time_changes.h"

namespace contactcheck {

struct ResultsDiff {
  std::vector<std::string> machine;       ///< "cpu A -> B": what makes it another machine
  std::vector<std::string> other_scenes;  ///< scenes whose exact truth is not the same
  std::vector<RowChange> changes;
  std::vector<TimeChange> times;
  std::vector<std::string> added, gone;  ///< scenes and detectors, in words
  std::size_t common = 0;                ///< rows that both have
};

ResultsDiff diff_results(const results::Results& before, const results::Results& after);

/// What `other` has and `results` lacks: whole scenes, then detectors with their scenes.
std::vector<std::string> missing_rows(const results::Index& results, const results::Results& other);

}  // namespace contactcheck
