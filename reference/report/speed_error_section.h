// The chart of speed against error in the Markdown report, and its points as a table.
#pragma once

#include <string>
#include <vector>

#include "reference/report/run_row.h"
#include "reference/report/speed_error.h"
#include "reference/results/results.h"

namespace contactcheck::report {

const std::vector<Column>& speed_error_columns();
std::vector<std::string> speed_error_cells(const SpeedErrorPoint& point);

/// The chart, what it shows, and its points as a table. Empty where nothing was timed.
std::string speed_error_markdown(const results::Results& results);

/// The picture that the section shows, empty where it shows none.
std::string speed_error_picture(const results::Results& results);

}  // namespace contactcheck::report
