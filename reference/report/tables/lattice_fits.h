// The errors of lattices that were fitted to recordings.
#pragma once

#include <string>

#include "reference/report/tables/table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// "judged with lattices fitted to recordings: vertices at most 1.20 mm off (body cloth, frame 7)",
/// for the vertex with the largest error. Empty for scenes without a fitted lattice.
std::string fits_line(const results::Scene& scene);

/// Per body the error over all frames and the worst frame. No rows without a fitted lattice.
TitledTable fits_table(const results::Scene& scene);

}  // namespace contactcheck::report
