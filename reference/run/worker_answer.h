// What a worker hands back to its parent: the answer file of its job, the cases beside it, and the
// scene's recording.
#pragma once

#include "reference/run/worker_state.h"

namespace contactcheck {

/// The nodes of all frames, into the job's recording file. Of random pairs none: their number and
/// seed say all, and take less room.
void record_scene(const WorkerState& worker);

/// Every detector's result, samples and contacts and what the next processes need to time the same
/// frames; a case file (case_file.h) per disagreement.
void write_answer(WorkerState& worker);

}  // namespace contactcheck
