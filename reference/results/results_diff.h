// Compares two results: worse, better, new and gone; as data and for a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reference/results/accuracy_changes.h"
#include "reference/results/results.h"

namespace contactcheck::results {

// Whether a detector became faster or slower, relative to a reference of the same run.

/// Smaller changes are not listed.
inline constexpr double kSmallestTimeChange = 0.05;

/// The speed-up over `reference` after divided by the one before: above 1 is faster.
struct TimeChange {
  std::string scene, detector, reference;
  Ratio factor;
  std::size_t passes = 0;  ///< the fewer of the two, for interval_name
};

/// The changes in playback of rows that have a speed-up over the same reference in both (the row's
/// first reference other than the detector): those whose interval excludes 1 and whose factor
/// differs from 1 by more than kSmallestTimeChange. A range must exclude 1 by the factor
/// kRangeFactor. Largest first.
std::vector<TimeChange> time_changes(const results::Index& before, const results::Results& after);

struct ResultsDiff {
  std::vector<std::string> machine;       ///< "cpu A -> B": differences of the machine
  std::vector<std::string> other_scenes;  ///< scenes whose exact ground truth differs
  std::vector<RowChange> changes;
  std::vector<TimeChange> times;
  std::vector<std::string> added, gone;  ///< scenes and detectors, as text
  std::size_t common = 0;                ///< rows that both have
};

ResultsDiff diff_results(const results::Results& before, const results::Results& after);

/// What `other` has and `results` lacks: whole scenes, then detectors with their scenes.
std::vector<std::string> missing_rows(const results::Index& results, const results::Results& other);

/// For a terminal: one section per kind of difference, the most important line first.
std::string diff_text(const ResultsDiff& diff);

/// "SCENE  DETECTOR  triangle missed 0 -> 3, spurious 1 -> 2, and 4 more".
std::string change_line(const RowChange& change);

/// The title, the first lines and the number of others, so that all sections fit on one screen;
/// empty without lines.
std::string section_text(const std::string& title, const std::vector<std::string>& lines);

}  // namespace contactcheck::results
