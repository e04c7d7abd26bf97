// The results as a table for spreadsheets and scripts: report.csv (fixtures/README.md).
#pragma once

#include <string>

#include "reference/results/results.h"

namespace contactcheck::report {

/// One line per scene and detector below a line of titles: RFC 4180 (CRLF, quotes doubled), UTF-8.
/// Numbers as results.json has them; a cell is empty where there is no value. The columns are the
/// same for all results but for the references, of which there are those that some run has a
/// speed-up against.
std::string csv_report(const results::Results& results);

}  // namespace contactcheck::report
