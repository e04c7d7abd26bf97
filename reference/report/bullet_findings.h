// What the results say about Bullet's soft-body queries.
#pragma once

#include <string>

#include "reference/results/results.h"

namespace contactcheck {

/// Markdown: what its units hide at scale 1, how few of the vertices inside its proximity query
/// reports, how many of its normals point the wrong way, and where the hulls of its clusters touch
/// though the surfaces do not. Each part only where the results hold its detectors.
std::string bullet_findings(const results::Results& results);

}  // namespace contactcheck
