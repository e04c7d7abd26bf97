// The whole suite, one line per detector.
#pragma once

#include <string>
#include <vector>

#include "reference/report/run_row.h"
#include "reference/results/results.h"

namespace contactcheck {

/// Columns of the summary, in order.
const std::vector<Column>& summary_columns();

/// One line of cells per detector and finest level judged, in the order of first runs: counts
/// summed over its scenes with status `ok`, the worst hover gap, and the range of its speed-ups
/// over scenes.
std::vector<std::vector<std::string>> summary_lines(const results::Results& results);

}  // namespace contactcheck
