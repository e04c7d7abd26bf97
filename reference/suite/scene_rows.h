// What the processes of one scene have answered, as one scene of results.json.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "reference/suite/finished_scene.h"
#include "reference/suite/job.h"
#include "reference/suite/suite_request.h"
#include "reference/suite/supervisor.h"

namespace contactcheck::suite {

/// How the worker of each detector that broke one has ended, by its position in the task.
using BrokenDetectors = std::map<std::uint32_t, WorkerOutcome>;

/// The turns of all passes, by the detector's position in the task.
using TakenTurns = std::map<std::uint32_t, std::vector<TurnAnswer>>;

using SampleListener = decltype(SuiteListener::samples);

/// References to what the caller keeps for the call.
struct SceneAnswers {
  const SceneTask& task;
  const SceneAnswer& judged;
  const TakenTurns& turns;
  const std::vector<std::size_t>& cold_frames;
  const BrokenDetectors& broken;
  bool recorded = false;  ///< the scene's recording is in its place
};

/// Where a worker was when it ended and why: "scene s, frame 2, phase update: signal 11 (...)".
std::string place_of(const std::string& scene, const WorkerOutcome& outcome);

/// A detector that fails in one turn has no times at all. Null: none failed.
const TurnAnswer* failed_turn(const TakenTurns& turns, std::uint32_t position);

/// The scene with one row per detector, in the task's order. A detector that broke a worker, or was
/// judged well and fails in a turn, has an error's row and no times. `tell` is given each
/// detector's samples before they are summed up.
FinishedScene assemble(const SceneAnswers& scene, const SampleListener& tell);

}  // namespace contactcheck::suite
