// Runs a simulated scene, which gives the frames that detectors are judged on.
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
  /// The driver's input at every judged frame, [frame][body][node].
  std::vector<std::vector<std::vector<Vec3>>> frames;
  /// The pairs of bodies that the driver reported at these frames.
  std::vector<std::vector<BodyPair>> reported;
  /// Total energy, Joule, at the start and after every step.
  std::vector<double> energy;
  double highest_kinetic = 0.0;  ///< Joule
  double last_speed = 0.0;       ///< m/s: root of the mean square over the mass, at the end
};

/// Called before every step with its number.
using OnStep = std::function<void(std::size_t)>;

/// Runs the scene with a detector in the loop: frames * every steps.
/// @throws InputError when it cannot drive; Diverged
SimulatedMotion simulate(const Scene& scene, Detector& detector, const OnStep& on_step);

/// The states before `wanted` steps, spread evenly over the motion (all states if there are fewer),
/// from which steps can be timed. @throws as simulate()
std::vector<SimulationState> states_along_motion(const Scene& scene, Detector& driver,
                                                 std::size_t wanted, const OnStep& on_step);

/// Checks what needs no step; does nothing for scenes that are not simulated. Does not make the
/// driver, because library code runs only in workers.
/// @throws InputError, one sentence with the scene: unknown driver, or a body too stiff
void check_simulation(const DetectorCatalog& catalog, const Scene& scene);

/// Fills scene.recorded by the scene's own driver; does nothing if the scene is not simulated.
/// @throws InputError, one sentence with the scene: unknown driver, one that cannot drive, a body
/// too stiff, or a motion that diverges
void record_simulation(const DetectorCatalog& catalog, const OnStep& on_step, Scene& scene);

}  // namespace contactcheck::scene
