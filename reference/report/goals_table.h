// What a suite hoped to measure.
#pragma once

#include "reference/report/markdown_table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// A row per goal; none where the suite has none.
TitledTable goals_table(const results::Results& results);

}  // namespace contactcheck::report
