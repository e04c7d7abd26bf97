// What a report says of lattices that were fitted to recordings: how far the scene is from them.
#pragma once

#include <string>

#include "reference/report/tables/table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// "judged with lattices fitted to recordings: vertices at most 1.20 mm off (body cloth, frame 7)",
/// of the vertex farthest from where it was recorded. Empty for scenes without a fitted lattice.
std::string fits_line(const results::Scene& scene);

/// Per body the error over all frames and the worst frame. No rows for scenes without a fitted
/// lattice.
TitledTable fits_table(const results::Scene& scene);

}  // namespace contactcheck::report
