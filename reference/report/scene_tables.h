// The Markdown tables of one scene beside the result table. Each is empty where its results are.
#pragma once

#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck {

using RunList = std::vector<const results::Run*>;

/// Every level of every detector: against the truth of the doubles and, for single precision,
/// against the truth of the values fed.
std::string levels_table(const RunList& runs);
/// Contour, distances, depths and normals.
std::string graded_table(const RunList& runs);
/// Which stage lost which true pairs, and what it visited.
std::string stages_table(const RunList& runs);
std::string times_table(const RunList& runs);
/// What detectors count, mean per frame.
std::string counters_table(const RunList& runs);
/// Every speed-up with its interval, by question and reference.
std::string speedups_table(const RunList& runs);

}  // namespace contactcheck
