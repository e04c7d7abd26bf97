// A simulated scene as its own deformer moves it, and as others do.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "reference/run/job.h"
#include "reference/tune/candidate.h"
#include "reference/tune/frame_split.h"

namespace contactcheck {

struct SimulatedModel {
  std::string deformer;        ///< "finite-elements"
  std::filesystem::path file;  ///< the scene that is moved by it
  FrameSplit split;            ///< recordings of its motion
  Cost step;                   ///< see step_cost.h; 0: not measured
  std::string failure;         ///< not empty: its simulation ended with this
};

struct SimulationRequest {
  std::filesystem::path scene_file;
  std::vector<std::string> deformers;  ///< to try beside the scene's own; empty: nothing is timed
  std::size_t frames = 0;              ///< of each half; 0: half of the scene's
  std::filesystem::path work;
  RunSettings settings;
};

/// Simulates the scene once with each deformer. The scene's own is the first. `starts` is told the
/// deformer whose simulation begins.
/// @throws InputError when the scene's own simulation fails, or has fewer than 4 frames
std::vector<SimulatedModel> simulate_models(const SimulationRequest& request,
                                            const DetectorCatalog& catalog,
                                            const std::function<void(const std::string&)>& starts);

}  // namespace contactcheck
