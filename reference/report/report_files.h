// The Markdown report with its pictures.
#pragma once

#include <map>
#include <string>

#include "reference/results/results.h"

namespace contactcheck::report {

/// Texts by path below the report's folder: report.md and plots/*.svg.
std::map<std::string, std::string> report_files(const results::Results& results);

}  // namespace contactcheck::report
