// The results as a table for spreadsheets and scripts: report.csv (fixtures/README.md).
#pragma once

#include <string>

#include "reference/results/results.h"

namespace contactcheck::report {

/// One line per scene and detector after a header line: RFC 4180 (CRLF, quotes doubled), UTF-8.
/// Numbers are those of results.json; a cell without a value is empty. All results have the same
/// columns, except that a reference has columns only if some run has a speed-up against it.
std::string csv_report(const results::Results& results);

/// A cell of such a table: in quotes where it has to be.
std::string csv_cell(const std::string& text);

}  // namespace contactcheck::report
