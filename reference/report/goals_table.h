// What a suite hoped to measure, as lines of a table.
#pragma once

#include <string>
#include <vector>

#include "reference/report/run_row.h"

namespace contactcheck {

const std::vector<Column>& goal_columns();
/// One line per goal; none where the suite has none.
std::vector<std::vector<std::string>> goal_lines(const results::Results& results);

}  // namespace contactcheck
