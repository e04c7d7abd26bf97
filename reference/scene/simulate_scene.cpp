#include "reference/scene/simulate_scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/types/check.h"
#include "reference/scene/driven_simulation.h"

namespace contactcheck::scene {
namespace {

double total_mass(const Scene& scene) {
  const auto& materials = scene.simulation()->materials;
  return std::accumulate(materials.begin(), materials.end(), 0.0,
                         [](double sum, const auto& m) { return sum + (m ? m->mass : 0.0); });
}

std::string place_of(const Scene& scene) {
  return "scene \"" + scene.id + "\", driver " + scene.simulation()->driver + ": ";
}

DetectorSpec parsed_driver(const DetectorCatalog& catalog, const Scene& scene) {
  DetectorSpec spec = catalog.parse(scene.simulation()->driver);
  const std::string& absent_because = catalog.find(spec.id)->absent_because;
  if (!absent_because.empty()) throw InputError(absent_because);
  return spec;
}

}  // namespace

SimulatedMotion simulate(const Scene& scene, Detector& detector, const OnStep& on_step) {
  const std::size_t every = scene.simulation()->every;
  DrivenSimulation driven(scene, detector);
  SimulatedMotion motion;
  motion.energy.push_back(driven.simulation().energy().total());
  for (std::size_t step = 0; step < scene.frames * every; ++step) {
    on_step(step);
    driven.step();
    const Energy energy = driven.simulation().energy();
    motion.energy.push_back(energy.total());
    motion.highest_kinetic = std::max(motion.highest_kinetic, energy.kinetic);
    motion.last_speed = std::sqrt(2.0 * energy.kinetic / std::max(total_mass(scene), 1e-300));
    if ((step + 1) % every != 0) continue;
    motion.frames.push_back(driven.nodes());
    // Element pairs imply their bodies: the set is canonical after a step.
    motion.reported.push_back(driven.contacts().bodies);
  }
  return motion;
}

std::vector<SimulationState> states_along_motion(const Scene& scene, Detector& driver,
                                                 std::size_t wanted, const OnStep& on_step) {
  const std::size_t steps = scene.frames * scene.simulation()->every;
  const std::size_t count = std::min(wanted, steps);
  DrivenSimulation driven(scene, driver);
  std::vector<SimulationState> states;
  for (std::size_t step = 0; step < steps && states.size() < count; ++step) {
    on_step(step);
    if (step == (2 * states.size() + 1) * steps / (2 * count))
      states.push_back(driven.simulation().state());
    driven.step();
  }
  return states;
}

void check_simulation(const DetectorCatalog& catalog, const Scene& scene) {
  if (!scene.simulation()) return;
  try {
    parsed_driver(catalog, scene);
    const Simulation at_rest(scene.bodies, scene.simulation()->materials,
                             scene.simulation()->settings, start_of(scene));
  } catch (const InputError& e) {
    throw InputError(place_of(scene) + e.what());
  }
}

void record_simulation(const DetectorCatalog& catalog, const OnStep& on_step, Scene& scene) {
  if (!scene.simulation()) return;
  const std::string place = place_of(scene);
  try {
    const std::unique_ptr<Detector> driver = catalog.make(parsed_driver(catalog, scene));
    scene.recorded = simulate(scene, *driver, on_step).frames;
  } catch (const InputError& e) {
    throw InputError(place + e.what());
  } catch (const RefusedInput& e) {
    throw InputError(place + e.what());
  } catch (const Diverged& e) {
    throw InputError(place + e.what());
  }
}

}  // namespace contactcheck::scene
