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

/// The turns of all passes, by the detector's position in the task.
class TakenTurns {
 public:
  /// Of the process that has taken them. A detector that fails in one has no times at all.
  void add(const std::vector<TurnAnswer>& answers);

  /// Seconds of its playbacks so far, in all questions.
  double seconds(std::uint32_t position) const;
  /// The first turn that failed; null: none did.
  const TurnAnswer* failure(std::uint32_t position) const;
  /// Of all turns, each once.
  std::vector<std::string> notes(std::uint32_t position) const;
  /// One per question, in the order of `questions`. @pre none of its turns failed
  std::vector<QuestionSamples> samples(std::uint32_t position,
                                       const std::vector<Question>& questions) const;

 private:
  std::map<std::uint32_t, std::vector<TurnAnswer>> turns_;
};

using SampleListener = decltype(SuiteListener::samples);

/// References to what the caller keeps for the call.
struct SceneAnswers {
  const SceneTask& task;
  const SceneAnswer& judged;
  const TakenTurns& turns;
  const std::vector<std::size_t>& cold_frames;
  const BrokenDetectors& broken;
  bool recorded = false;  ///< the scene's recording stands in its place
};

/// The scene with one row per detector, in the task's order. A detector that broke a worker, or
/// was judged well and fails in a turn, has an error's row and no times. `tell` is given each
/// detector's samples before they are summed up.
FinishedScene put_together(const SceneAnswers& scene, const SampleListener& tell);

/// Where a worker was when it ended and why: "scene s, frame 2, phase update: signal 11 (...)".
std::string place_of(const std::string& scene, const WorkerOutcome& outcome);

}  // namespace contactcheck
