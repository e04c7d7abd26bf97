// Time and error against separation, of scenes that are distance sweeps.
#pragma once

#include <vector>

#include "reference/report/scene_tables.h"

namespace contactcheck {

/// A row per detector and a column per separation: the median time of a frame over the orientations
/// that were timed (where there are such), and missed and spurious contacts over all of them. None
/// for scenes that are no sweep.
std::vector<TitledTable> separation_tables(const results::Scene& scene, const RunList& runs);

}  // namespace contactcheck
