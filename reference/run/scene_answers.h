// What the processes of one scene have answered, as one scene of results.json.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "reference/run/partial_results.h"
#include "reference/run/suite_run.h"
#include "reference/run/supervisor.h"

namespace contactcheck {

/// How the worker of each detector that broke one has ended, by its position in the task.
using BrokenDetectors = std::map<std::uint32_t, WorkerOutcome>;

using SampleListener = decltype(SuiteListener::samples);

/// References to what the caller keeps for the call.
struct SceneAnswers {
  const SceneTask& task;
  const std::vector<SceneAnswer>& answers;  ///< per process, the one that judged first
  const BrokenDetectors& broken;
  bool recorded = false;  ///< the scene's recording stands in its place
};

/// The scene with one row per detector, in the task's order. A detector that broke a worker, or
/// worked in the first process and not in a later one, has an error's row and no times. `tell` is
/// given each detector's samples before they are summed up.
FinishedScene put_together(const SceneAnswers& scene, const SampleListener& tell);

/// Where a worker was when it ended and why: "scene s, frame 2, phase update: signal 11 (...)".
std::string place_of(const std::string& scene, const WorkerOutcome& outcome);

}  // namespace contactcheck
