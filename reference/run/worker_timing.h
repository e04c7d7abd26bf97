// The turns of a worker that times.
#pragma once

#include "reference/run/worker_state.h"

namespace contactcheck {

/// Takes the job's turns in order: each a fresh instance, prepared outside the clock. A detector
/// that throws in one, or answers otherwise than when it was judged, has no later ones.
void take_turns(WorkerState& worker);

}  // namespace contactcheck
