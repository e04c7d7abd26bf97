// One scene of a run: its worker processes, one after the other, and what becomes of those that
// die.
#pragma once

#include <filesystem>

#include "reference/suite/finished_scene.h"
#include "reference/suite/suite_request.h"
#include "reference/suite/supervisor.h"

namespace contactcheck::suite {

/// Judges (and times) one scene of a request. A worker that dies in a detector is started again
/// without it, and one that passes a limit while the oracle judges is started again without the
/// oracle: its detectors all end in that error.
/// Jobs, answers and cases go to `scratch`, an existing folder.
/// @throws std::runtime_error when a worker dies in another way in the suite's own code;
/// InputError when it refuses the scene
FinishedScene run_scene(const SuiteRequest& request, const SceneTask& task,
                        const std::filesystem::path& scratch, const SuiteListener& listener,
                        const ProgressCallback& on_progress);

}  // namespace contactcheck::suite
