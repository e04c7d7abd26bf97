#include "reference/run/worker_timing.h"

#include "reference/run/guarded_call.h"
#include "reference/run/schedule.h"
#include "reference/run/timing.h"

namespace contactcheck {
namespace {

TimedEntry timed_entry(const WorkerEntry& entry, const JudgedQuestion& judged, std::size_t frames) {
  TimedEntry timed;
  timed.position = entry.position;
  timed.detector = entry.detector.get();
  timed.question = judged.question;
  timed.own = judged.question == entry.run.semantics.questions.front();
  timed.judged = &judged.frames;
  timed.frames = frames;
  timed.samples.question = judged.question;
  timed.samples.lazy_map = !entry.detector->needs_vertices();
  return timed;
}

std::vector<TimedEntry> timed_entries(const WorkerState& worker) {
  std::vector<TimedEntry> timed;
  for (const WorkerEntry& entry : worker.entries) {
    if (!entry.usable() || !entry.detector) continue;
    for (const JudgedQuestion& question : entry.accuracy.answers)
      timed.push_back(timed_entry(entry, question, worker.job.prefixes[entry.position]));
  }
  return timed;
}

void take_samples(const WorkerState& worker, TimedEntry& timed, WorkerEntry& entry) {
  if (!entry.usable()) return;  // another question of this detector threw
  if (timed.error.empty()) {
    entry.samples.push_back(std::move(timed.samples));
    return;
  }
  book_error(worker, timed.error, entry);
  entry.samples.clear();
}

}  // namespace

void plan_timing(WorkerState& worker) {
  const RunSettings& s = worker.job.settings;
  worker.job.order = timing_order(worker.judged.contact_frames);
  worker.job.prefixes.assign(s.detectors.size(), 0);
  for (const WorkerEntry& entry : worker.entries) {
    if (!entry.usable()) continue;
    // One repeat runs cold and hot.
    worker.job.prefixes[entry.position] =
        frames_within_budget(s.time_budget, 2.0 * entry.accuracy.seconds_per_frame, s.repeats,
                             s.fewest_timed_frames, worker.scene.frames);
  }
}

void time_detectors(WorkerState& worker) {
  std::vector<TimedEntry> timed = timed_entries(worker);
  if (timed.empty()) return;
  const RunSettings& s = worker.job.settings;
  run_timing(worker.judged, worker.job.order, s.repeats, s.sweep_bytes, timed, worker.progress);
  for (TimedEntry& t : timed)
    for (WorkerEntry& entry : worker.entries)
      if (entry.position == t.position) take_samples(worker, t, entry);
}

}  // namespace contactcheck
