#include "reference/suite/worker_judging.h"

#include <algorithm>
#include <utility>

#include "reference/judge/accuracy.h"
#include "reference/judge/hover.h"
#include "reference/suite/guarded_call.h"

namespace contactcheck::suite {
namespace {

void add_entry(std::uint32_t position, WorkerState& worker) {
  WorkerEntry entry;
  entry.position = position;
  entry.spec = worker.catalog.parse(worker.job.settings.detectors[position]);
  entry.run.scene = worker.scene.id;
  entry.run.detector = entry.spec.name;
  entry.run.options = entry.spec.options;
  entry.run.frames = worker.scene.frames;
  const DetectorInfo* info = worker.catalog.find(entry.spec.id);
  if (!info->absent_because.empty()) {
    entry.run.status = results::Status::kAbsent;
    entry.run.message = info->absent_because;
  }
  worker.entries.push_back(std::move(entry));
}

void judge(judge::JudgingTools& tools, WorkerState& worker, WorkerEntry& entry) {
  make_detector(worker, entry);
  entry.accuracy =
      judge::run_accuracy(tools, entry.position, *entry.detector, worker.progress, entry.run);
  judge::measure_hover_gaps(tools, entry.position, *entry.detector, worker.progress, entry.run);
}

}  // namespace

void make_detector(WorkerState& worker, WorkerEntry& entry) {
  worker.progress.enter(entry.position, 0, process::Phase::kPrepare);
  entry.detector = worker.catalog.make(entry.spec);
}

void dismiss(WorkerState& worker, WorkerEntry& entry) {
  worker.progress.enter(entry.position, worker.progress.frame(), process::Phase::kDestroy);
  entry.detector.reset();
}

void add_entries(WorkerState& worker) {
  const std::vector<std::uint32_t>& skip = worker.job.skip;
  for (std::uint32_t i = 0; i < worker.job.settings.detectors.size(); ++i)
    if (std::find(skip.begin(), skip.end(), i) == skip.end()) add_entry(i, worker);
}

void end_all(WorkerState& worker, results::Status status, const std::string& message,
             std::optional<std::size_t> failed_frame) {
  for (WorkerEntry& entry : worker.entries) {
    if (!entry.usable()) continue;
    entry.run.status = status;
    entry.run.failed_frame = failed_frame;
    entry.run.message = message;
  }
}

void judge_detectors(WorkerState& worker) {
  judge::JudgingTools tools(worker.judged);
  const auto count = static_cast<double>(worker.entries.size());
  for (std::size_t i = 0; i < worker.entries.size(); ++i) {
    WorkerEntry& entry = worker.entries[i];
    worker.progress.part(judge::kShareOfTruth + 0.9 * static_cast<double>(i) / count);
    if (!entry.usable()) continue;
    guarded(worker, entry, [&] { judge(tools, worker, entry); });
    if (entry.detector) guarded(worker, entry, [&] { dismiss(worker, entry); });
  }
}

}  // namespace contactcheck::suite
