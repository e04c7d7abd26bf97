// The untimed part of a worker: its detectors made, judged, and dismissed.
#pragma once

#include "reference/run/worker_state.h"

namespace contactcheck {

/// All detectors of the job but those that it skips; one that is absent says so already.
void add_entries(WorkerState& worker);

/// Of a scene that was refused or cannot be judged: so ends every detector that could have run.
void end_all(WorkerState& worker, results::Status status, const std::string& message,
             std::optional<std::size_t> failed_frame = {});

/// Every usable detector is made, runs over all frames and is judged (accuracy.h, hover.h).
/// Without timing nobody asks it again, and it is dismissed at once.
void judge_detectors(WorkerState& worker);

/// For a process that only times: makes and prepares the detectors that the job times.
void prepare_detectors(WorkerState& worker);

/// Destroys what is left of them, one after another: one that crashes here is no detector to use.
void dismiss_all(WorkerState& worker);

}  // namespace contactcheck
