// A worker that judges: its detectors made, judged, and dismissed.
#pragma once

#include "reference/suite/worker_state.h"

namespace contactcheck::suite {

/// All detectors of the job but those that it skips; one that is absent says so already.
void add_entries(WorkerState& worker);

/// Of a scene that was refused or cannot be judged: so ends every detector that could have run.
void end_all(WorkerState& worker, results::Status status, const std::string& message,
             std::optional<std::size_t> failed_frame = {});

/// Every usable detector is made, runs over all frames, is judged (accuracy.h, hover.h) and
/// destroyed: one that crashes there is no detector to use.
void judge_detectors(WorkerState& worker);

/// In calls of the detector's own (guarded_call.h).
void make_detector(WorkerState& worker, WorkerEntry& entry);
void dismiss(WorkerState& worker, WorkerEntry& entry);

}  // namespace contactcheck::suite
