#include "reference/run/worker_simulation.h"

#include "reference/run/cache_sweep.h"
#include "reference/run/closed_loop.h"
#include "reference/run/guarded_call.h"
#include "reference/run/lockstep.h"
#include "reference/simulate/driven_simulation.h"

namespace contactcheck {
namespace {

bool drives(const WorkerEntry& entry) {
  return entry.usable() && why_no_driver(entry.run.semantics).empty();
}

std::vector<LockstepEntry> lockstep_entries(WorkerState& worker) {
  std::vector<LockstepEntry> lockstep;
  for (WorkerEntry& entry : worker.entries) {
    if (!drives(entry)) continue;
    std::unique_ptr<Detector> made;
    guarded(worker, entry, [&] {
      worker.progress.enter(entry.position, 0, Phase::kPrepare);
      made = worker.catalog.make(entry.spec);
    });
    if (made) lockstep.push_back({entry.position, std::move(made), 0, {}, ""});
  }
  return lockstep;
}

void end_lockstep(WorkerState& worker, LockstepEntry& timed, WorkerEntry& entry) {
  if (timed.error.empty()) {
    entry.run.step_ms = step_times(timed);
  } else {
    book_error(worker, timed.error, entry);
  }
  guarded(worker, entry, [&] {
    worker.progress.enter(entry.position, worker.progress.frame(), Phase::kDestroy);
    timed.detector.reset();
  });
}

void time_whole_steps(WorkerState& worker) {
  std::vector<LockstepEntry> lockstep = lockstep_entries(worker);
  const DetectorSpec driver = worker.catalog.parse(worker.scene.simulation->driver);
  LockstepSettings settings;
  settings.repeats = worker.job.settings.step_repeats;
  settings.sweep_bytes = sweep_bytes();
  run_lockstep(worker.scene, *worker.catalog.make(driver), settings, lockstep, worker.progress);
  for (LockstepEntry& timed : lockstep)
    for (WorkerEntry& entry : worker.entries)
      if (entry.position == timed.position) end_lockstep(worker, timed, entry);
}

}  // namespace

void simulate_with_detectors(WorkerState& worker) {
  for (WorkerEntry& entry : worker.entries) {
    if (!drives(entry)) continue;
    guarded(worker, entry, [&] {
      entry.run.closed_loop = run_closed_loop(
          worker.scene, entry.position, [&] { return worker.catalog.make(entry.spec); },
          worker.progress);
    });
  }
  if (worker.job.settings.timing) time_whole_steps(worker);
}

}  // namespace contactcheck
