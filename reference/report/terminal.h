#pragma once

#include <string>

#include "reference/results/results.h"

namespace contactcheck::report {

/// The result tables of all scenes as aligned plain text, with a legend. `color` adds ANSI colours
/// to misses, spurious contacts and errors.
std::string terminal_tables(const results::Results& results, bool color);

}  // namespace contactcheck::report
