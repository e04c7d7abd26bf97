// Recordings of checked frames, to judge detectors by.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "reference/check/check_summary.h"
#include "reference/scene/scene.h"

namespace contactcheck::check {

/// What `--keep` names: "17", a frame, or "36-37", the two of a step. @throws InputError
std::vector<std::size_t> kept_frames(const std::string& word, std::size_t frames);

/// OUT/frame-N.ccr or OUT/frames-N-M.ccr of each that is `wanted`, and of the first frame or step
/// that is not allowed. Reads them once more. @throws InputError
void write_recordings(const std::vector<std::vector<std::size_t>>& wanted,
                      const CheckSummary& summary, const scene::Scene& scene,
                      const std::filesystem::path& out);

}  // namespace contactcheck::check
