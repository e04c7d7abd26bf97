// What families of hard cases say about each detector: how many it gets right, and from which value
// of the parameter on it goes wrong.
#pragma once

#include <string>
#include <vector>

#include "reference/report/run_row.h"

namespace contactcheck {

/// One line per detector: families and cases, how many of them it answered as it claims, missed and
/// spurious, errors, and what a case costs. Empty without families.
const std::vector<Column>& hard_columns();
std::vector<std::vector<std::string>> hard_lines(const results::Results& results);

/// Markdown: those lines and, per family, who goes wrong from which value on. Empty without
/// families.
std::string hard_cases_markdown(const results::Results& results);

}  // namespace contactcheck
