// The Markdown report with its pictures.
#pragma once

#include <map>
#include <string>

#include "reference/report/tables/table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// The title as a heading of the third order, the text, the table and an empty line; nothing
/// without rows. A cell cannot end its column or its line.
std::string markdown_of(const TitledTable& table);

/// The Markdown report: where and how it was measured, every section, of each scene a section with
/// its bodies, result table, losses per stage and disagreements, and how to read the columns.
std::string markdown_report(const results::Index& index);

/// The report and its pictures by path below the report's folder: report.md and plots/*.svg.
std::map<std::string, std::string> report_files(const results::Results& results);

}  // namespace contactcheck::report
