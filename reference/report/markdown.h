// The Markdown report with its pictures.
#pragma once

#include <map>
#include <string>

#include "reference/results/results.h"

namespace contactcheck::report {

/// The Markdown report: where and how it was measured, what it says about the claims, one section
/// per scene (bodies, result table, losses per stage, disagreements), and how to read the columns.
std::string markdown_report(const results::Results& results);

/// The report and its pictures by path below the report's folder: report.md and plots/*.svg.
std::map<std::string, std::string> report_files(const results::Results& results);

}  // namespace contactcheck::report
