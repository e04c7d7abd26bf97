// From a simulated scene to the frames that detectors are judged on.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/detect/detector.h"
#include "core/detect/registry.h"
#include "core/dynamics/simulation.h"
#include "reference/scene/scene.h"

namespace contactcheck::scene {

/// One simulation from start to end.
struct SimulatedMotion {
  /// What the driver was given at every judged frame, [frame][body][node].
  std::vector<std::vector<std::vector<Vec3>>> frames;
  /// The pairs of bodies that it reported then.
  std::vector<std::vector<BodyPair>> reported;
  /// Joule, after every step, the start first.
  std::vector<double> energy;
  double highest_kinetic = 0.0;  ///< Joule
  double last_speed = 0.0;       ///< m/s: root of the mean square over the mass, at the end
};

/// Called before every step with its number.
using OnStep = std::function<void(std::size_t)>;

/// Runs the scene with a detector in the loop: frames * every steps.
/// @throws InputError when it cannot drive; Diverged
SimulatedMotion simulate(const Scene& scene, Detector& detector, const OnStep& on_step);

/// The states before `wanted` steps, spread evenly over the motion (all of them where there are
/// fewer): what steps may be timed from. @throws as simulate()
std::vector<SimulationState> states_along_motion(const Scene& scene, Detector& driver,
                                                 std::size_t wanted, const OnStep& on_step);

/// What can be told without a step; nothing to do for scenes that are not simulated. The driver is
/// not made: a library's code runs in workers alone.
/// @throws InputError, one sentence with the scene: no such driver, or a body too stiff
void check_simulation(const DetectorCatalog& catalog, const Scene& scene);

/// Fills scene.recorded by the scene's own driver; nothing to do for scenes that are not simulated.
/// @throws InputError, one sentence with the scene: no such driver, one that cannot drive, a body
/// too stiff, or the motion diverged
void record_simulation(const DetectorCatalog& catalog, const OnStep& on_step, Scene& scene);

}  // namespace contactcheck::scene
