// In which range of sizes, and of distances from the origin, each detector is right.
#pragma once

#include <vector>

#include "reference/report/markdown_table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// One table for families whose parameter is a size and one for those whose is a distance
/// (results::Family::range), as far as there are such; a row per detector that they have in common.
/// A value is right for a detector when it answers the case as it claims in every family that has
/// the value; without an answer (error, refused) no case of a family is. The range is the longest
/// run of right values (the first of equally long ones); beside it stand the nearest wrong cases.
/// @throws InputError for a value that is no number, or results that lack a case
std::vector<TitledTable> scale_ranges(const results::Results& results);

}  // namespace contactcheck::report
