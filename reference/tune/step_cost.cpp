#include "reference/tune/step_cost.h"

#include <algorithm>
#include <chrono>

#include "reference/run/cache_sweep.h"
#include "reference/simulate/driven_simulation.h"
#include "reference/statistics/statistics.h"
#include "reference/tune/paired_cost.h"

namespace contactcheck {
namespace {

/// A scene, where its motion comes by, and what each of these steps took.
class StepTimer {
 public:
  StepTimer(const Scene& scene, const DetectorCatalog& catalog, const StepCostSettings& settings,
            const OnStep& on_step)
      : driver_(catalog.make(catalog.parse(scene.simulation->driver))),
        states_(states_on_the_way(scene, *driver_, settings.steps, on_step)),
        driven_(scene, *driver_),
        now_ms_(settings.now_ms),
        samples_(states_.size()) {}

  void time(std::size_t state) {
    if (state >= states_.size()) return;
    driven_.simulation().restore(states_[state]);
    const double start = now_ms_();
    driven_.deform();
    // A clock that has not ticked has seen a nanosecond at most.
    samples_[state].push_back(std::max(now_ms_() - start, 1e-6));
  }
  double mean() const {
    double sum = 0.0;
    for (const std::vector<double>& repeats : samples_) sum += median(repeats);
    return sum / static_cast<double>(samples_.size());
  }
  // Motions of different length may share the first states alone.
  Ratio beside(const StepTimer& anchor) const {
    PairedRun run;
    for (std::size_t state = 0; state < std::min(samples_.size(), anchor.samples_.size()); ++state)
      run[state] = {samples_[state], anchor.samples_[state]};
    return relative_cost({run});
  }

 private:
  std::unique_ptr<Detector> driver_;
  std::vector<SimulationState> states_;
  DrivenSimulation driven_;
  const std::function<double()>& now_ms_;
  std::vector<std::vector<double>> samples_;  ///< [state][repeat]
};

}  // namespace

double steady_now_ms() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double, std::milli>(Clock::now().time_since_epoch()).count();
}

std::vector<Cost> step_costs(const std::vector<Scene>& scenes, const DetectorCatalog& catalog,
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
  if (timers.empty()) return {};
  const double unit = timers.front()->mean();
  std::vector<Cost> costs;
  for (const auto& timer : timers) {
    const Ratio ratio = timer->beside(*timers.front());
    costs.push_back({unit * ratio.value, unit * ratio.low, unit * ratio.high});
  }
  return costs;
}

}  // namespace contactcheck
