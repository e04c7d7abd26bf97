// Two results compared: what got worse, better, new and gone; as data and for a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reference/results/accuracy_changes.h"
#include "reference/results/results.h"

namespace contactcheck::results {

// Whether a detector has become faster or slower against a reference of the same run.

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

/// For a terminal: one section per kind of difference, the most important line first.
std::string diff_text(const ResultsDiff& diff);

/// "SCENE  DETECTOR  triangle missed 0 -> 3, spurious 1 -> 2, and 4 more differences".
std::string change_line(const RowChange& change);

/// The title, the first lines and how many more there are, so that all sections fit on one screen;
/// empty without lines.
std::string section_text(const std::string& title, const std::vector<std::string>& lines);

}  // namespace contactcheck::results
