// What a suite hoped to measure, as lines of a table.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reference/report/run_row.h"

namespace contactcheck {

const std::vector<Column>& goal_columns();
/// One line per goal; none where the suite has none.
std::vector<std::vector<std::string>> goal_lines(const nlohmann::ordered_json& results);

}  // namespace contactcheck
