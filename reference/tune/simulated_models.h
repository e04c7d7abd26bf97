// A simulated scene as its own deformer moves it, and as others do.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "core/dynamics/material.h"
#include "reference/scene/scene.h"
#include "reference/scene/simulate_scene.h"
#include "reference/suite/job.h"
#include "reference/tune/candidate.h"
#include "reference/tune/frame_split.h"

namespace contactcheck::tune {

// What a step of a simulation costs without its collision test.

/// Milliseconds of the steady clock, from some moment on.
double steady_now_ms();

struct StepCostSettings {
  std::size_t steps = 24;  ///< of the motion, spread evenly over it
  std::size_t repeats = 5;
  std::size_t sweep_bytes = 0;  ///< read before each step
  std::function<double()> now_ms = steady_now_ms;
};

/// Per scene what a step costs: deformation, gravity, ground and held contacts ("Updating MSS"),
/// from states of the scene's own motion, with cold caches. The scenes take turns (A B C, next
/// repeat B C A). The first one's milliseconds are the mean over states of the median over repeats;
/// those of the others are that times what they cost beside it (paired_cost.h), so that they differ
/// by what the deformers differ by, and not by what the machine did meanwhile. Intervals are those
/// of these ratios: the first one's is the unit, and has none.
/// @pre the scenes are simulated, and their drivers have driven them
std::vector<Cost> step_costs(const std::vector<scene::Scene>& scenes,
                             const DetectorCatalog& catalog, const StepCostSettings& settings,
                             const scene::OnStep& on_step);

// A simulated scene with bodies that another model deforms.

/// What deforms the bodies of a simulated scene: "mass-spring"; "mixed" where they differ.
/// @pre the scene is simulated @throws InputError when none of its bodies can be moved
std::string deformer_of(const scene::Scene& scene);

/// Writes the scene of `file`, every material made the equivalent one of `model`
/// (core/dynamics/equivalent_material.h), into `folder`, shape matching with substeps no longer
/// than its relaxation time; the id gets "-MODEL" behind it. Returns
/// the new file. @throws InputError for scenes that cannot be read
std::filesystem::path write_deformer_variant(const std::filesystem::path& file,
                                             DeformableModel model,
                                             const std::filesystem::path& folder);

struct SimulatedModel {
  std::string deformer;        ///< "finite-elements"
  std::filesystem::path file;  ///< the scene that is moved by it
  FrameSplit split;            ///< recordings of its motion
  Cost step;                   ///< 0: not measured
  std::string failure;         ///< not empty: its simulation ended with this
};

struct SimulationRequest {
  std::filesystem::path scene_file;
  std::vector<std::string> deformers;  ///< to try beside the scene's own; empty: nothing is timed
  std::size_t frames = 0;              ///< of each half; 0: half of the scene's
  std::filesystem::path work;
  suite::RunSettings settings;
};

/// Simulates the scene once with each deformer, its own first. Calls `starts` with the deformer
/// before each simulation.
/// @throws InputError when the scene's own simulation fails, or has fewer than 4 frames
std::vector<SimulatedModel> simulate_models(const SimulationRequest& request,
                                            const DetectorCatalog& catalog,
                                            const std::function<void(const std::string&)>& starts);

}  // namespace contactcheck::tune
