// Time and error against separation, of scenes that are distance sweeps.
#pragma once

#include <string>

#include "reference/report/scene_tables.h"
#include "reference/results/results.h"

namespace contactcheck {

/// Markdown, a line per detector and a column per separation: the median time of a frame over the
/// orientations that were timed, and missed and spurious contacts over all of them. Empty for
/// scenes that are no sweep.
std::string separation_tables(const results::Scene& scene, const RunList& runs);

}  // namespace contactcheck
