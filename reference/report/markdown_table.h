// Tables, as every kind of report has them, and as Markdown.
#pragma once

#include <string>
#include <vector>

#include "reference/report/run_row.h"

namespace contactcheck::report {

/// A table with what is said above it. `Code` is in backticks.
struct TitledTable {
  std::string title, text;  ///< either may be empty
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;
  std::string id = {};  ///< where something leads to it
};

/// The title as a heading of the third order, the text, the table and an empty line; nothing
/// without rows. A cell cannot end its column or its line.
std::string markdown_of(const TitledTable& table);

}  // namespace contactcheck::report
