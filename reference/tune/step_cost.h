// What a step of a simulation costs without its collision test.
#pragma once

#include <cstddef>
#include <vector>

#include "core/detect/registry.h"
#include "reference/scene/scene.h"
#include "reference/simulate/simulate_scene.h"

namespace contactcheck {

struct StepCostSettings {
  std::size_t steps = 24;  ///< of the motion, spread evenly over it
  std::size_t repeats = 5;
  std::size_t sweep_bytes = 0;  ///< read and written before each step
};

/// Milliseconds per step and scene: deformation, gravity, ground and held contacts ("Updating
/// MSS"), from states of the scene's own motion, with cold caches; the median over repeats, the
/// mean over states. The scenes take turns (A B C, next repeat B C A).
/// @pre the scenes are simulated, and their drivers have driven them
std::vector<double> step_costs(const std::vector<Scene>& scenes, const DetectorCatalog& catalog,
                               const StepCostSettings& settings, const OnStep& on_step);

}  // namespace contactcheck
