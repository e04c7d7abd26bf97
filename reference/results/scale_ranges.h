// The sizes and distances from the origin at which detectors are right (fixtures/hard/ranges.json):
// read, updated, and compared with the scenes of a run.
#pragma once

#include <filesystem>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::results {

/// Reads ranges.json of the folder; empty if there is no such file.
/// @throws InputError with file, place and value
std::vector<ScaleRange> read_scale_ranges(const std::filesystem::path& folder);

/// Writes under a temporary name, then renames. @throws InputError with the path if that fails
void write_scale_ranges(const std::filesystem::path& folder, const std::vector<ScaleRange>& ranges);

/// Replaces the ranges of the same detector, library, version and `by` with those of a run.
std::vector<ScaleRange> updated(std::vector<ScaleRange> known, const std::vector<ScaleRange>& run);

/// The ranges of a run's detectors, for the versions of their libraries in the run.
std::vector<ScaleRange> ranges_of_run(const std::vector<ScaleRange>& known, const Results& results);

/// True if triangles of the scene are smaller or larger than the range, or farther from the origin
/// (in lengths of the shortest edge, which suffers first from rounding), or if the range is empty.
bool outside(const ScaleRange& range, const SceneScale& scale);

}  // namespace contactcheck::results
