// What the results say about claims of the paper and of the libraries, scene by scene.
#pragma once

#include <string>
#include <vector>

#include "reference/report/markdown_table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// Those that the results have rows for: the hover gaps of ffd-grid and ffd-aabb side by side (the
/// paper's claim: the first is larger); the speed of sphere2 against FCL and Embree in the
/// questions that both answer, with the errors of both; what FCL takes for contact; what Bullet's
/// queries mean; in which sizes each detector is known to be right.
std::vector<TitledTable> claims_of(const results::Results& results);

/// The same for the Markdown report.
std::string claims_markdown(const results::Results& results);

}  // namespace contactcheck::report
