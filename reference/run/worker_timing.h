// The timed part of a worker: which frames are timed, and the samples of each detector.
#pragma once

#include "reference/run/worker_state.h"

namespace contactcheck {

/// Sets the job's order of frames and, per detector, how many of them its time budget holds: out of
/// what the judging took, for this process and those that only time.
void plan_timing(WorkerState& worker);

/// Times every usable detector with each of its questions (timing.h). One that throws meanwhile
/// or answers otherwise than when it was judged ends in an error, without samples.
void time_detectors(WorkerState& worker);

}  // namespace contactcheck
