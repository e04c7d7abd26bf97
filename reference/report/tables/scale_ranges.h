// The ranges of sizes and of distances from the origin in which each detector is right.
#pragma once

#include <string>
#include <vector>

#include "reference/report/tables/table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// Ranges of size, then ranges of distance (Family::range), one per detector that is in all
/// families of that kind; library and version are not set. A value is right if the detector answers
/// its case as claimed in every family that has the value; without an answer (error, refused) all
/// cases of a family are wrong. The range is the longest run of right values, the first of equally
/// long ones.
/// @throws InputError for a value that is not a number, or results that lack a case
std::vector<results::ScaleRange> scale_ranges(const results::Index& index);

/// A table of the ranges of size and one of the ranges of distance, without empty ones.
std::vector<TitledTable> range_tables(const std::vector<results::ScaleRange>& ranges);

/// Results::known_ranges with the scenes of the run; no rows without scenes that have a scale.
TitledTable known_ranges_table(const results::Index& index);

/// The detectors for which some scene of the run is out of range, each once.
std::vector<std::string> detectors_out_of_range(const results::Index& index);

/// "DETECTOR  BY  as listed -> as shown", one line per difference; empty if all agree.
std::string range_changes(const std::vector<results::ScaleRange>& listed,
                          const std::vector<results::ScaleRange>& shown);

}  // namespace contactcheck::report
