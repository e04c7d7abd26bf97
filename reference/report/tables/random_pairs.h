// A scene of random pairs in reports: number, seed, and the oracle compared with rational
// arithmetic.
#pragma once

#include <string>

#include "reference/report/tables/table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// "10,000,000 pairs, seed 1, 5,012,345 touch; oracle against rational arithmetic: 0 wrong".
/// Empty for scenes without pairs.
std::string pairs_line(const results::Scene& scene);

/// The number of touching pairs by kind, below that line; no rows for scenes without pairs.
TitledTable pairs_table(const results::Scene& scene);

}  // namespace contactcheck::report
