// What a step of a simulation costs without its collision test.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/detect/registry.h"
#include "reference/scene/scene.h"
#include "reference/simulate/simulate_scene.h"
#include "reference/tune/candidate.h"

namespace contactcheck {

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
std::vector<Cost> step_costs(const std::vector<Scene>& scenes, const DetectorCatalog& catalog,
                             const StepCostSettings& settings, const OnStep& on_step);

}  // namespace contactcheck
