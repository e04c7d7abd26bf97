// Calls of a worker's detectors: whatever one of them throws or leaves behind is its own result.
#pragma once

#include <functional>
#include <string>

#include "reference/suite/worker_state.h"

namespace contactcheck::suite {

/// Does `work`, which calls the detector of `entry`. What it throws ends in the entry's status and
/// message: absent, refused, or an error with scene, frame and phase. What it changed for the whole
/// process is restored and noted.
void guarded(WorkerState& worker, WorkerEntry& entry, const std::function<void()>& work);

/// The error that a pass of its own caught: `what` with the scene before it.
void book_error(const WorkerState& worker, const std::string& what, WorkerEntry& entry);

}  // namespace contactcheck::suite
