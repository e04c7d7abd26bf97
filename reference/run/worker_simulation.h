// A worker's simulated scene with its detectors in the loop: what their errors and their time do to
// a simulation.
#pragma once

#include "reference/run/worker_state.h"

namespace contactcheck {

/// For every usable detector that can drive: the motion that it drives, judged (closed_loop.h),
/// and, with timing, whole steps timed (lockstep.h).
/// @pre worker.scene.simulation has a value
void simulate_with_detectors(WorkerState& worker);

}  // namespace contactcheck
