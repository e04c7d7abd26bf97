// What a run is asked for, and what it tells while it works.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reference/results/known_defects.h"
#include "reference/results/results.h"
#include "reference/scene/scene.h"
#include "reference/suite/job.h"
#include "reference/suite/shard.h"
#include "reference/timing/speedup.h"

namespace contactcheck::suite {

struct SceneTask {
  std::string id;
  scene::SceneSource source;
  std::vector<std::string> detectors;  ///< canonical names
  /// Detectors to give speed-ups over, in addition to the usual references.
  std::vector<std::string> references;
  std::size_t frames = 0;    ///< that will be judged
  std::string content = "";  ///< hash of the scene's text and meshes: the same, the same scene
};

/// Which part of which run.
struct ShardOfRun {
  Shard shard;
  std::vector<SceneTask> run;  ///< all scenes of the run, in order
};

struct SuiteRequest {
  std::vector<SceneTask> tasks;
  std::vector<results::Goal> goals;      ///< canonical names of detectors
  RunSettings settings;                  ///< detectors are taken from the tasks
  std::filesystem::path out;             ///< existing, writable
  std::filesystem::path executable;      ///< this program, for its hidden subcommand `worker`
  std::string command;                   ///< for the record
  std::vector<results::Plugin> plugins;  ///< for the record
  results::KnownDefects known_defects;   ///< what wrong answers are set beside
  /// Take over the scenes that an earlier run has finished in `out` (see PartialResults).
  bool resume = false;
  /// Discard the finished scenes of an interrupted run that this one does not take over.
  bool overwrite = false;
  std::optional<ShardOfRun> shard = {};  ///< then `tasks` are those that it holds
};

/// What is going on, for the progress display.
struct SuiteProgress {
  std::size_t scene = 0, scenes = 0;
  std::string scene_id, detector;      ///< no detector: the suite's own work
  std::optional<std::uint32_t> frame;  ///< none: no frame is being judged or timed
  std::size_t frames = 0;              ///< of the scene
  double share = 0.0;                  ///< of the whole suite
};

/// A scene that is finished, as it will stand in the results.
struct SceneEnd {
  std::string scene_id;
  bool resumed = false;  ///< taken over from an interrupted run
  const std::vector<results::Run>& runs;
};

/// What a run tells while it works.
struct SuiteListener {
  /// Before the first scene of a run that resumes: the scenes that it takes over.
  std::function<void(const std::vector<std::string>& ids)> resumed =
      [](const std::vector<std::string>&) {};
  /// At the start of a scene that is run, and a few times per second.
  std::function<void(const SuiteProgress&)> progress = [](const SuiteProgress&) {};
  std::function<void(const SceneEnd&)> scene_end = [](const SceneEnd&) {};
  /// What a scene's detector was timed with in one question, before it is summed up.
  std::function<void(const std::string& scene, const std::string& detector,
                     const timing::QuestionSamples&)>
      samples = [](const std::string&, const std::string&, const timing::QuestionSamples&) {};
};

struct SuiteOutcome {
  bool unlisted_error = false;     ///< some `error` is no known defect of its detector
  std::uint64_t oracle_wrong = 0;  ///< random pairs on which rational arithmetic contradicts it
};

}  // namespace contactcheck::suite
