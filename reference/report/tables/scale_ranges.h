// In which range of sizes, and of distances from the origin, each detector is right.
#pragma once

#include <string>
#include <vector>

#include "reference/report/tables/table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// Of families whose parameter is a size, then of those whose is a distance (Family::range), one
/// per detector that they have in common; without library and version. A value is right for a
/// detector when it answers the case as it claims in every family that has the value; without an
/// answer (error, refused) no case of a family is. The range is the longest run of right values
/// (the first of equally long ones).
/// @throws InputError for a value that is no number, or results that lack a case
std::vector<results::ScaleRange> scale_ranges(const results::Index& index);

/// A table of those by size and one of those by distance, as far as there are such.
std::vector<TitledTable> range_tables(const std::vector<results::ScaleRange>& ranges);

/// Results::known_ranges beside the scenes of the run; no rows without scenes that have a scale.
TitledTable known_ranges_table(const results::Index& index);

/// Those that some scene of the run is too small, too large or too far out for, each once.
std::vector<std::string> detectors_out_of_range(const results::Index& index);

/// "DETECTOR  BY  as listed -> as shown" per line, for those that differ; empty: none does.
std::string range_changes(const std::vector<results::ScaleRange>& listed,
                          const std::vector<results::ScaleRange>& shown);

}  // namespace contactcheck::report
