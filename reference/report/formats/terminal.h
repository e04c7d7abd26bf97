#pragma once

#include <string>

#include "reference/results/results.h"

namespace contactcheck::report {

/// The verdict in one line, and the result tables of all scenes as aligned plain text. Columns
/// without a value are left out, and others until lines have at most 100 characters. `color` adds
/// ANSI colours to misses, spurious contacts and errors; `explain` adds the meaning of all columns
/// shown and how times were measured.
std::string terminal_tables(const results::Results& results, bool color, bool explain = false);

/// The meaning of all columns of result tables, one line each.
std::string column_legend();

}  // namespace contactcheck::report
