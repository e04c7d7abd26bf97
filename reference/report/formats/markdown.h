// The Markdown report with its pictures.
#pragma once

#include <map>
#include <string>

#include "reference/report/tables/table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// The title as a heading of level 3, the text, the table and an empty line; empty without rows.
/// Cells are escaped, so that they cannot end their column or line.
std::string markdown_of(TitledTable table);

/// The Markdown report: origin and machine, every section, for each scene its bodies, result table,
/// losses per stage and disagreements, and an explanation of the columns.
std::string markdown_report(const results::Index& index);

/// The report and its pictures, by path below the report's folder: report.md and plots/*.svg.
std::map<std::string, std::string> report_files(const results::Results& results);

}  // namespace contactcheck::report
