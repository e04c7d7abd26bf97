// Lines of Markdown tables.
#pragma once

#include <string>
#include <vector>

#include "reference/report/run_row.h"

namespace contactcheck {

/// "| a | b |" and a line end; a cell cannot end its column or its line.
std::string table_line(const std::vector<std::string>& cells);
/// The titles and the rule below them.
std::string table_head(const std::vector<Column>& columns);
/// A paragraph, a table and an empty line; nothing without rows.
std::string titled_table(const std::string& paragraph, const std::vector<Column>& columns,
                         const std::string& rows);

}  // namespace contactcheck
