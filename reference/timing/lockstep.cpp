#include "reference/timing/lockstep.h"

#include <algorithm>
#include <chrono>

#include "reference/process/float_environment.h"
#include "reference/results/statistics.h"
#include "reference/scene/driven_simulation.h"
#include "reference/scene/simulate_scene.h"
#include "reference/text/printable.h"
#include "reference/timing/cache_sweep.h"

namespace contactcheck::timing {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

// The phase is marked outside of what the clock takes, which the mark must not lengthen.
void run_step(const SimulationState& from, scene::DrivenSimulation& driven, StepSum& sum,
              process::ProgressWriter& progress) {
  driven.simulation().restore(from);
  const auto start = Clock::now();
  driven.deform();
  const auto deformed = Clock::now();
  driven.update_cells();
  const auto updated = Clock::now();
  progress.go_on(process::Phase::kQuery);
  const auto before_test = Clock::now();
  driven.test();
  const auto tested = Clock::now();
  driven.respond();
  const auto answered = Clock::now();
  sum.mss += milliseconds(start, deformed);
  sum.cell += milliseconds(deformed, updated);
  sum.test += milliseconds(before_test, tested);
  sum.response += milliseconds(tested, answered);
}

/// An entry with its simulation; an entry that throws takes no further part.
struct Runner {
  LockstepEntry* entry = nullptr;
  std::unique_ptr<scene::DrivenSimulation> driven;

  template <typename Work>
  void guarded(const Work& work) {
    if (!entry->error.empty()) return;
    try {
      work();
    } catch (...) {
      entry->error = "in lockstep: " + text::current_exception_text();
      entry->steps = 0;
      entry->sums.clear();
    }
  }
};

std::vector<Runner> make_runners(const scene::Scene& scene, std::vector<LockstepEntry>& entries,
                                 process::ProgressWriter& progress) {
  std::vector<Runner> runners;
  for (LockstepEntry& entry : entries) {
    progress.enter(entry.position, 0, process::Phase::kPrepare);
    Runner& runner = runners.emplace_back(Runner{&entry, nullptr});
    runner.guarded(
        [&] { runner.driven = std::make_unique<scene::DrivenSimulation>(scene, *entry.detector); });
    entry.detector->pause();
  }
  return runners;
}

}  // namespace

void run_lockstep(const scene::Scene& scene, Detector& driver, const LockstepSettings& settings,
                  std::vector<LockstepEntry>& entries, process::ProgressWriter& progress) {
  const std::vector<SimulationState> states =
      scene::states_along_motion(scene, driver, settings.steps, [&](std::size_t step) {
        progress.enter(process::SharedProgress::kNoDetector, step, process::Phase::kTruth);
      });
  for (LockstepEntry& entry : entries) {
    entry.steps = states.size();
    entry.sums.resize(settings.repeats);
  }
  std::vector<Runner> runners = make_runners(scene, entries, progress);
  CacheSweep sweep(settings.sweep_bytes);
  const process::FloatEnvironmentGuard guard;
  for (std::size_t repeat = 0; repeat < settings.repeats; ++repeat)
    for (const SimulationState& state : states)
      for (std::size_t i = 0; i < runners.size(); ++i) {
        Runner& runner = runners[(i + repeat) % runners.size()];
        runner.guarded([&] {
          progress.enter(runner.entry->position, state.steps, process::Phase::kUpdate);
          sweep.run();
          runner.entry->detector->resume();
          run_step(state, *runner.driven, runner.entry->sums[repeat], progress);
          runner.entry->detector->pause();
        });
        guard.check_and_restore();
      }
}

results::StepTimes step_times(const LockstepEntry& entry) {
  const auto steps = static_cast<double>(entry.steps);
  const auto per_step = [&](double StepSum::*part) {
    std::vector<double> values;
    for (const StepSum& sum : entry.sums) values.push_back(sum.*part);
    return results::median(std::move(values)) / steps;
  };
  results::StepTimes out;
  out.steps = entry.steps;
  out.repeats = entry.sums.size();
  const StepSum mean{per_step(&StepSum::mss), per_step(&StepSum::cell), per_step(&StepSum::test),
                     per_step(&StepSum::response)};
  out.mss = mean.mss;
  out.cell = mean.cell;
  out.test = mean.test;
  out.response = mean.response;
  out.total = mean.total();
  for (const StepSum& sum : entry.sums) {
    out.test_by_repeat.push_back(sum.test / steps);
    out.total_by_repeat.push_back(sum.total() / steps);
  }
  return out;
}

}  // namespace contactcheck::timing
