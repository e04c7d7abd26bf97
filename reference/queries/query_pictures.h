// What judging queries found, as pictures: by the length of edges.
#pragma once

#include <string>
#include <vector>

#include "reference/queries/query_judge.h"

namespace contactcheck::queries {

// Both have decades from 1e-12 to 1e6 m.

/// An SVG document: the largest errors of the time of contact against the longest edge, over all
/// files; early as solid lines, late as dashed ones. Empty where no detector reports times.
std::string time_error_picture(const std::vector<FileScore>& scores);

/// An SVG document: median microseconds a query against the longest edge. Empty without queries.
std::string cost_picture(const std::vector<FileScore>& scores);

}  // namespace contactcheck::queries
