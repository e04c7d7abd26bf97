// In which sizes and how far from the origin detectors are right, as fixtures/hard/ranges.json
// says: read, brought up to date, and held against the scenes of a run.
#pragma once

#include <filesystem>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::results {

/// ranges.json of the folder; where there is none, nothing.
/// @throws InputError with file, place and value
std::vector<ScaleRange> read_scale_ranges(const std::filesystem::path& folder);

/// Under a temporary name, then renamed. @throws InputError with the path when it cannot be
void write_scale_ranges(const std::filesystem::path& folder, const std::vector<ScaleRange>& ranges);

/// With those of a run in place of those of the same detector, library, version and `by`.
std::vector<ScaleRange> updated(std::vector<ScaleRange> known, const std::vector<ScaleRange>& run);

/// Those of a run's detectors, in the versions of their libraries that it has.
std::vector<ScaleRange> ranges_of_run(const std::vector<ScaleRange>& known, const Results& results);

/// Whether triangles of the scene are smaller or larger than the range, or farther from the origin:
/// in edges of the shortest, which rounding meets first. Always, where the detector is right
/// nowhere.
bool outside(const ScaleRange& range, const SceneScale& scale);

}  // namespace contactcheck::results
