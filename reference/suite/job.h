// What one run is asked to do, as the parent hands it to its workers, and what they hand back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reference/judge/answer_fingerprint.h"
#include "reference/results/results.h"
#include "reference/scene/random_pairs.h"
#include "reference/scene/scene.h"
#include "reference/timing/speedup.h"

namespace contactcheck::suite {

/// Settings of a run; the same for all its scenes.
struct RunSettings {
  std::vector<std::string> detectors;  ///< canonical names
  /// Records of the detectors from outside this program that are among them (plugin/plugin.h).
  std::vector<std::string> plugins;
  std::vector<std::string> plugin_ids;  ///< theirs; a worker need not know
  std::size_t frames = 0;               ///< 0: as the scene says
  std::size_t processes = 3;            ///< passes, each in a fresh process
  double one_pass_beyond = 2.0;  ///< seconds for all its questions: a slower detector has one pass;
                                 ///< 0: no limit
  std::uint64_t seed = 1;        ///< of the order of detectors and of the cold frames
  std::size_t step_repeats = 5;  ///< of whole steps, timed in lockstep
  bool timing = true;
  /// Simulated scenes: drive them with every detector too, and (with timing) time whole steps.
  bool closed_loop = false;
  std::uint32_t threads = 1;  ///< that deform bodies of simulated scenes; no result depends on it
  double call_limit = 60.0;   ///< seconds without progress until a worker is stopped
  std::uint64_t memory_limit = std::uint64_t{4} << 30;  ///< bytes resident
};

/// Each by its name, values as JSON; the detectors, which every scene has of its own, left out.
std::vector<std::pair<std::string, std::string>> named_settings(const RunSettings& settings);

/// A scene that passes a limit while the oracle is at work.
struct Unjudged {
  std::string why;  ///< with the place
  std::uint32_t frame = 0;
};

/// What a worker that times does next: a fresh instance of a detector through all frames, or, in
/// its own question, through the cold ones.
struct Turn {
  std::uint32_t position = 0;  ///< in the job's list
  Question question = Question::kTriangles;
  bool cold = false;
};

/// One worker's job: one scene, to be judged by all detectors, or turns of some to be timed.
struct Job {
  scene::SceneSource scene;
  RunSettings settings;
  std::vector<std::uint32_t> skip;  ///< positions of detectors that broke an earlier try
  /// Where an earlier try has shown that the oracle cannot judge the scene: it is not asked again,
  /// and all detectors end in this error.
  std::optional<Unjudged> unjudged;
  std::vector<Turn> turns;               ///< empty: judge
  std::vector<std::size_t> cold_frames;  ///< with turns
  /// With turns: per detector, what was judged; empty of those that have no turn.
  std::vector<judge::JudgedAnswers> answers;
  std::filesystem::path answer_file;  ///< where the worker writes
  /// Where the one that judges writes it, and those that time find it; empty: nowhere.
  std::filesystem::path recording_file;
  /// The temporary folder of whom it starts (TMPDIR); empty: everybody's.
  std::filesystem::path temporary;
};

void write_job(const std::filesystem::path& file, const Job& job);
Job read_job(const std::filesystem::path& file);

/// What became of one detector that was judged.
struct DetectorAnswer {
  std::uint32_t position = 0;    ///< in the job's list
  results::Run run;              ///< without times
  judge::JudgedAnswers answers;  ///< for the processes that time; empty without them
  std::string contacts;          ///< its part of contacts/SCENE.json (contacts_json.h); empty: none
};

/// What became of a turn.
struct TurnAnswer {
  Turn turn;
  std::string error;  ///< not empty: there are no samples
  std::optional<std::size_t> failed_frame;
  bool lazy_map = false;  ///< see QuestionSamples
  timing::Pass samples;
  std::vector<std::string> notes;  ///< what it printed or changed for the whole process
};

/// A worker's answer to its job: with turns, `timed` alone.
struct SceneAnswer {
  results::Scene scene;
  std::vector<bool> contact_frames;
  std::vector<bool> contact_steps;  ///< by step, if the scene judges contact within steps
  std::vector<results::Disagreement> disagreements;  ///< each with the path of its case file
  std::string truth_contacts;                        ///< of contacts/SCENE.json; empty: no file
  std::vector<DetectorAnswer> detectors;
  std::vector<TurnAnswer> timed;
};

void write_answer(const std::filesystem::path& file, SceneAnswer answer);
/// @throws nlohmann::json::exception for a file that write_answer did not write
SceneAnswer read_answer(const std::filesystem::path& file);

/// Samples, as they are kept. @throws nlohmann::json::exception for what is no such JSON
nlohmann::ordered_json samples_json(timing::QuestionSamples samples);
timing::QuestionSamples samples_from_json(const nlohmann::ordered_json& json);

/// @throws InputError with the path when it is no regular file or cannot be read
std::string read_text_file(const std::filesystem::path& file);

}  // namespace contactcheck::suite
