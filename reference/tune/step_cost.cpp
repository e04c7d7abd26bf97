#include "reference/tune/step_cost.h"

#include <chrono>

#include "reference/compare/speedup.h"
#include "reference/run/timing.h"
#include "reference/simulate/driven_simulation.h"

namespace contactcheck {
namespace {

using Clock = std::chrono::steady_clock;

/// A scene, where its motion comes by, and what each of these steps took.
class StepTimer {
 public:
  StepTimer(const Scene& scene, const DetectorCatalog& catalog, const StepCostSettings& settings,
            const OnStep& on_step)
      : driver_(catalog.make(catalog.parse(scene.simulation->driver))),
        states_(states_on_the_way(scene, *driver_, settings.steps, on_step)),
        driven_(scene, *driver_),
        samples_(states_.size()) {}

  void time(std::size_t state) {
    if (state >= states_.size()) return;
    driven_.simulation().restore(states_[state]);
    const auto start = Clock::now();
    driven_.deform();
    const std::chrono::duration<double, std::milli> taken = Clock::now() - start;
    samples_[state].push_back(taken.count());
  }
  double mean() const {
    double sum = 0.0;
    for (const std::vector<double>& repeats : samples_) sum += median(repeats);
    return sum / static_cast<double>(samples_.size());
  }

 private:
  std::unique_ptr<Detector> driver_;
  std::vector<SimulationState> states_;
  DrivenSimulation driven_;
  std::vector<std::vector<double>> samples_;  ///< [state][repeat]
};

}  // namespace

std::vector<double> step_costs(const std::vector<Scene>& scenes, const DetectorCatalog& catalog,
                               const StepCostSettings& settings, const OnStep& on_step) {
  std::vector<std::unique_ptr<StepTimer>> timers;
  for (const Scene& scene : scenes)
    timers.push_back(std::make_unique<StepTimer>(scene, catalog, settings, on_step));
  CacheSweep sweep(settings.sweep_bytes);
  for (std::size_t repeat = 0; repeat < settings.repeats; ++repeat)
    for (std::size_t state = 0; state < settings.steps; ++state)
      for (std::size_t i = 0; i < timers.size(); ++i) {
        sweep.run();
        timers[(i + repeat) % timers.size()]->time(state);
      }
  std::vector<double> costs;
  for (const auto& timer : timers) costs.push_back(timer->mean());
  return costs;
}

}  // namespace contactcheck
