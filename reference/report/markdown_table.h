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
/// A table with what is said above it, for every kind of report. `Code` stands in backticks.
struct TitledTable {
  std::string title, text;  ///< either may be empty
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;
  std::string id = {};  ///< where something leads to it
};

/// The title as a heading of the third order, the text, the table and an empty line; nothing
/// without rows.
std::string markdown_of(const TitledTable& table);

/// A paragraph, a table and an empty line; nothing without rows.
std::string titled_table(const std::string& paragraph, const std::vector<Column>& columns,
                         const std::string& rows);

}  // namespace contactcheck
