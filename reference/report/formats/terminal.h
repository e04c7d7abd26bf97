#pragma once

#include <set>
#include <string>

#include "reference/results/results.h"

namespace contactcheck::report {

/// The verdict in one line, and the result tables of all scenes as aligned plain text. Columns
/// without a value are left out, and as many others as it takes for lines of 100 characters.
/// `color` adds ANSI colours to misses, spurious contacts and errors; `explain` the meaning of all
/// columns shown and how times were taken.
std::string terminal_tables(const results::Results& results, bool color, bool explain = false);

/// What the columns of these tables with a title in `shown` mean, a line each; none: of all.
std::string column_legend(const std::set<std::string>& shown = {});

}  // namespace contactcheck::report
