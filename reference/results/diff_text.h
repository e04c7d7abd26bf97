#pragma once

#include <string>

#include "reference/results/results_diff.h"

namespace contactcheck::results {

/// Lines that a section shows before it says how many more there are: all sections of a diff fit on
/// one screen.
inline constexpr std::size_t kLinesPerSection = 5;

/// For a terminal: one section per kind of difference, the most important line first.
std::string diff_text(const ResultsDiff& diff);

/// "SCENE  DETECTOR  triangle missed 0 -> 3, spurious 1 -> 2, and 4 more differences".
std::string change_line(const RowChange& change);

}  // namespace contactcheck::results
