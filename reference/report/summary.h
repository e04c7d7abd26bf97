// The whole suite, one line per detector.
#pragma once

#include "reference/report/markdown_table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// A row per detector and finest level judged, in the order of first runs: counts summed over its
/// scenes with status `ok`, the worst hover gap, and the range of its speed-ups over scenes.
TitledTable summary_table(const results::Results& results);

}  // namespace contactcheck::report
