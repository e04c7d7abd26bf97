#include "reference/run/worker_judging.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "reference/run/accuracy.h"
#include "reference/run/guarded_call.h"
#include "reference/run/hover.h"

namespace contactcheck {
namespace {

void add_entry(std::uint32_t position, WorkerState& worker) {
  WorkerEntry entry;
  entry.position = position;
  entry.spec = worker.catalog.parse(worker.job.settings.detectors[position]);
  entry.result.scene = worker.scene.id;
  entry.result.detector = entry.spec.name;
  entry.result.options = entry.spec.options;
  entry.result.frames = worker.scene.frames;
  const DetectorInfo* info = worker.catalog.find(entry.spec.id);
  if (!info->absent_because.empty()) {
    entry.result.status = RunStatus::kAbsent;
    entry.result.message = info->absent_because;
  }
  worker.entries.push_back(std::move(entry));
}

void make_detector(WorkerState& worker, WorkerEntry& entry) {
  worker.progress.enter(entry.position, 0, Phase::kPrepare);
  entry.detector = worker.catalog.make(entry.spec);
}

// Nobody asks it again: what it holds shall not count against those after it.
void dismiss(WorkerState& worker, WorkerEntry& entry) {
  worker.progress.enter(entry.position, worker.progress.frame(), Phase::kDestroy);
  entry.detector.reset();
}

void judge(JudgingTools& tools, WorkerState& worker, WorkerEntry& entry) {
  make_detector(worker, entry);
  AccuracyOutcome outcome =
      run_accuracy(tools, entry.position, *entry.detector, worker.progress, entry.result);
  entry.seconds_per_frame = outcome.seconds_per_frame;
  entry.answers = std::move(outcome.answers);
  measure_hover_gaps(tools, entry.position, *entry.detector, worker.progress, entry.result);
  if (!worker.job.settings.timing) dismiss(worker, entry);
}

// What it is timed with here was judged in another process.
void take_over_answers(const WorkerState& worker, WorkerEntry& entry) {
  entry.answers = worker.job.answers[entry.position];
  const bool same =
      std::equal(entry.answers.begin(), entry.answers.end(),
                 entry.result.semantics.questions.begin(), entry.result.semantics.questions.end(),
                 [](const JudgedQuestion& judged, Question now) { return judged.question == now; });
  if (!same) throw std::runtime_error("it answers other questions than when it was judged");
}

}  // namespace

void add_entries(WorkerState& worker) {
  const std::vector<std::uint32_t>& skip = worker.job.skip;
  for (std::uint32_t i = 0; i < worker.job.settings.detectors.size(); ++i)
    if (std::find(skip.begin(), skip.end(), i) == skip.end()) add_entry(i, worker);
}

void end_all(WorkerState& worker, RunStatus status, const std::string& message,
             std::optional<std::size_t> failed_frame) {
  for (WorkerEntry& entry : worker.entries) {
    if (!entry.usable()) continue;
    entry.result.status = status;
    entry.result.failed_frame = failed_frame;
    entry.result.message = message;
  }
}

void judge_detectors(WorkerState& worker) {
  JudgingTools tools(worker.judged);
  const auto count = static_cast<double>(worker.entries.size());
  for (std::size_t i = 0; i < worker.entries.size(); ++i) {
    WorkerEntry& entry = worker.entries[i];
    worker.progress.part(kShareOfTruth + 0.4 * static_cast<double>(i) / count);
    if (!entry.usable()) continue;
    guarded(worker, entry, [&] { judge(tools, worker, entry); });
    for (Disagreement& d : entry.result.disagreements) {
      d.scene = worker.scene.id;
      d.detector = entry.spec.name;
    }
  }
}

void prepare_detectors(WorkerState& worker) {
  for (WorkerEntry& entry : worker.entries) {
    if (!entry.usable() || worker.job.prefixes[entry.position] == 0) continue;
    guarded(worker, entry, [&] {
      make_detector(worker, entry);
      entry.result.semantics = entry.detector->semantics();
      entry.detector->prepare(worker.scene.bodies);
      take_over_answers(worker, entry);
    });
  }
}

void dismiss_all(WorkerState& worker) {
  for (WorkerEntry& entry : worker.entries)
    if (entry.detector) guarded(worker, entry, [&] { dismiss(worker, entry); });
}

}  // namespace contactcheck
