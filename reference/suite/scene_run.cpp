#include "reference/suite/scene_run.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/types/check.h"
#include "core/types/hash.h"
#include "reference/judge/contacts_json.h"
#include "reference/process/exit_codes.h"
#include "reference/results/references.h"
#include "reference/scene/drawn_scene.h"
#include "reference/suite/partial_results.h"
#include "reference/suite/suite_request.h"
#include "reference/suite/supervisor.h"
#include "reference/suite/worker.h"
#include "reference/text/printable.h"
#include "reference/timing/cache_sweep.h"
#include "reference/timing/schedule.h"
#include "reference/timing/speedup.h"

namespace contactcheck::suite {
namespace {

// Where a worker was when it ended and why: "scene s, frame 2, phase update: signal 11 (...)".
std::string place_of(const std::string& scene, const WorkerOutcome& outcome) {
  return process::place_text(scene, outcome.frame, outcome.phase) + ": " + outcome.reason;
}

// What the processes of one scene have answered, as one scene of results.json.

/// How the worker of each detector that broke one has ended, by its position in the task.
using BrokenDetectors = std::map<std::uint32_t, WorkerOutcome>;

/// The turns of all passes, by the detector's position in the task.
using TakenTurns = std::map<std::uint32_t, std::vector<TurnAnswer>>;

using Samples = std::vector<timing::QuestionSamples>;  // one per question

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

const std::vector<TurnAnswer>& turns_of(const TakenTurns& turns, std::uint32_t position) {
  static const std::vector<TurnAnswer> none;
  const auto found = turns.find(position);
  return found == turns.end() ? none : found->second;
}

// A detector that fails in one turn has no times at all. Null: none failed.
const TurnAnswer* failed_turn(const TakenTurns& turns, std::uint32_t position) {
  for (const TurnAnswer& answer : turns_of(turns, position))
    if (!answer.error.empty()) return &answer;
  return nullptr;
}

template <typename Value>
bool contains(const std::vector<Value>& values, const Value& value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

// The result of judging, and what the turns add to it but times. Fills `samples` where the detector
// was timed without a failure.
results::Run judged_row(const SceneAnswers& scene, const DetectorAnswer& detector,
                        Samples& samples) {
  results::Run run = detector.run;
  if (scene.recorded) run.recording = "recordings/" + scene.task.id + ".ccr";
  const std::vector<TurnAnswer>& turns = turns_of(scene.turns, detector.position);
  std::vector<std::string> notes;
  for (const TurnAnswer& answer : turns)
    for (const std::string& note : answer.notes)
      if (!contains(notes, note)) notes.push_back(note);
  for (const std::string& note : notes)
    if (!contains(detector.run.notes, note)) run.notes.push_back(note + " (while timed)");
  if (!run.ok() || turns.empty()) return run;
  if (const TurnAnswer* failed = failed_turn(scene.turns, detector.position)) {
    // It was judged well and fails now: that is its result.
    run.status = results::Status::kError;
    run.message = failed->error;
    run.failed_frame = failed->failed_frame;
    return run;
  }
  for (const Question question : run.semantics.questions) {
    timing::QuestionSamples& of_question = samples.emplace_back();
    of_question.question = question;
    for (const TurnAnswer& answer : turns) {
      if (answer.turn.question != question) continue;
      of_question.lazy_map = answer.lazy_map;
      (answer.turn.cold ? of_question.cold : of_question.playback).push_back(answer.samples);
    }
  }
  return run;
}

results::Run broken_row(const SceneAnswers& scene, std::uint32_t position) {
  const WorkerOutcome& outcome = scene.broken.at(position);
  results::Run run;
  run.scene = scene.task.id;
  run.detector = scene.task.detectors[position];
  run.status = results::Status::kError;
  run.failed_frame = outcome.frame;
  run.message = place_of(scene.task.id, outcome) +
                (outcome.detector ? "" : " in the suite's own code, after this detector had run");
  run.frames = scene.judged.scene.frames;
  run.contact_frames = scene.judged.scene.contact_frames;
  return run;
}

// Contacts are the same question only where they are of one kind: depth of vertices, of triangles
// or of boxes.
bool same_contacts(const Semantics& semantics, const Semantics& other) {
  return semantics.depth == other.depth &&
         contains(semantics.levels, Level::kTriangle) == contains(other.levels, Level::kTriangle);
}

// The scene with one row per detector, in the task's order. A detector that broke a worker, or
// was judged well and fails in a turn, has an error's row and no times. `tell` is given each
// detector's samples before they are summed up.
FinishedScene assemble(const SceneAnswers& scene, const SampleListener& tell) {
  const SceneAnswer& judged = scene.judged;
  const std::vector<std::string>& names = scene.task.detectors;
  std::map<std::uint32_t, Samples> samples;
  std::map<std::uint32_t, results::Run> runs;
  for (const DetectorAnswer& detector : judged.detectors) {
    if (scene.broken.contains(detector.position)) continue;
    Samples own;
    runs[detector.position] = judged_row(scene, detector, own);
    if (!own.empty()) samples[detector.position] = std::move(own);
  }

  // Times, and speed-ups over the references in the same question.
  const timing::TimedFrames frames = {judged.contact_frames, scene.cold_frames};
  for (const auto& [position, own] : samples) {
    results::Run& run = runs.at(position);
    run.per_frame.frame_ms = timing::frame_ms(own.front());
    for (const timing::QuestionSamples& question : own) {
      run.times.push_back(timing::summarize_times(question, frames));
      for (const auto& [other, theirs] : samples) {
        const std::string& name = names[other];
        const bool is_reference =
            results::is_reference(name) || contains(scene.task.references, name);
        const auto same =
            std::ranges::find(theirs, question.question, &timing::QuestionSamples::question);
        if (!is_reference || same == theirs.end()) continue;
        const results::Run& reference = runs.at(other);
        if (question.question == Question::kContacts &&
            !same_contacts(run.semantics, reference.semantics))
          continue;
        if (question.question == Question::kBody && reference.semantics.no_early_end) continue;
        results::Speedup speedup = timing::compute_speedup(*same, question, frames);
        speedup.reference_options = reference.options;
        run.speedup[question.question][name] = std::move(speedup);
      }
    }
  }
  for (const auto& [position, questions] : samples)
    for (const timing::QuestionSamples& question : questions)
      tell(scene.task.id, names[position], question);

  FinishedScene finished;
  finished.scene = judged.scene;
  finished.scene.cold_frames = scene.cold_frames;
  for (std::uint32_t i = 0; i < names.size(); ++i)
    finished.runs.push_back(scene.broken.contains(i) ? broken_row(scene, i)
                                                     : std::move(runs.at(i)));
  for (const results::Disagreement& d : judged.disagreements) {
    const auto broke = [&](const auto& broken) { return names[broken.first] == d.detector; };
    if (std::none_of(scene.broken.begin(), scene.broken.end(), broke))
      finished.disagreements.push_back(d);
  }
  if (judged.truth_contacts.empty()) return finished;
  // Of those whose answers count: one that broke later, in another process, has no contacts either.
  std::vector<std::string> contacts;
  for (const DetectorAnswer& detector : judged.detectors)
    if (finished.runs.at(detector.position).ok() && !detector.contacts.empty())
      contacts.push_back(detector.contacts);
  finished.scene.contacts = judge::contacts_path(scene.task.id);
  finished.contacts = judge::contacts_text(scene.task.id, judged.truth_contacts, contacts);
  return finished;
}

namespace fs = std::filesystem;

// The processes of one scene: one that judges, then those of each pass.
class SceneRun {
 public:
  SceneRun(const SuiteRequest& request, const SceneTask& task, const fs::path& scratch,
           const ProgressCallback& on_progress)
      : request_(request), task_(task), scratch_(scratch), on_progress_(on_progress) {
    // The worker's working directory is for libraries to change.
    job_.scene = scene::absolute(task.source);
    job_.settings = request.settings;
    job_.settings.detectors = task.detectors;
  }

  FinishedScene finish(const SampleListener& tell) {
    const fs::path recording = request_.out / "recordings" / (task_.id + ".ccr");
    job_.recording_file = fs::absolute(recording);
    const SceneAnswer judged = run_process();
    const bool recorded = !judged.truth_contacts.empty() && fs::exists(recording);
    if (!recorded) job_.recording_file.clear();  // there may be one of an earlier run
    if (job_.settings.timing) time(judged);
    return assemble({task_, judged, turns_, job_.cold_frames, broken_, recorded}, tell);
  }

 private:
  void time(const SceneAnswer& judged) {
    const RunSettings& s = job_.settings;
    for (std::size_t pass = 0; pass < s.processes; ++pass) {
      std::vector<std::vector<Turn>> processes = processes_of(judged, pass);
      if (processes.empty()) return;
      if (pass == 0) job_.cold_frames = timing::draw_cold_frames(judged.contact_frames, s.seed);
      for (std::size_t i = 0; i < processes.size(); ++i) {
        done_ = (1.0 + static_cast<double>(pass) +
                 static_cast<double>(i) / static_cast<double>(processes.size()));
        part_ = 1.0 / static_cast<double>(processes.size());
        job_.turns = std::move(processes[i]);
        // What was judged, of the detectors that have a turn: of all together it is long.
        job_.answers.assign(task_.detectors.size(), {});
        for (const DetectorAnswer& detector : judged.detectors)
          if (std::ranges::find(job_.turns, detector.position, &Turn::position) != job_.turns.end())
            job_.answers.at(detector.position) = detector.answers;
        for (const TurnAnswer& answer : run_process().timed)
          turns_[answer.turn.position].push_back(answer);
      }
      // By the first pass alone: pass p of one detector is set beside pass p of another.
      if (pass > 0 || s.one_pass_beyond == 0.0) continue;
      for (const auto& [position, answers] : turns_) {
        double nanoseconds = 0.0;  // of its playbacks, in all questions
        for (const TurnAnswer& answer : answers)
          for (const timing::PhaseSample& frame : answer.samples)
            if (!answer.turn.cold) nanoseconds += frame.total();
        if (1e-9 * nanoseconds > s.one_pass_beyond) slow_.insert(position);
      }
    }
  }

  // The turns of one pass in an order drawn by seed, by the process that takes them: each turn of a
  // detector from outside has one for itself, since what it keeps in memory is out of our hands.
  std::vector<std::vector<Turn>> processes_of(const SceneAnswer& judged, std::size_t pass) const {
    std::vector<Turn> turns;
    for (const DetectorAnswer& detector : judged.detectors) {
      const std::uint32_t position = detector.position;
      if (!detector.run.ok() || broken_.contains(position) ||
          failed_turn(turns_, position) != nullptr || (pass > 0 && slow_.contains(position)))
        continue;
      const std::vector<Question>& questions = detector.run.semantics.questions;
      for (const Question question : questions) turns.push_back({position, question, false});
      turns.push_back({position, questions.front(), true});
    }
    // Another order in every scene, or one detector would always follow the same other.
    Fnv1a seed;
    seed.bytes(task_.id.data(), task_.id.size());
    const std::uint64_t numbers[] = {job_.settings.seed, pass};
    seed.bytes(numbers, sizeof numbers);
    std::vector<std::vector<Turn>> out;
    std::optional<std::size_t> own;  // the process of our detectors
    for (const std::size_t i : timing::draw_order(turns.size(), seed.digest())) {
      const std::string& name = task_.detectors[turns[i].position];
      if (contains(job_.settings.plugin_ids, name.substr(0, name.find(':')))) {
        out.push_back({turns[i]});
        continue;
      }
      if (!own) {
        own = out.size();
        out.emplace_back();
      }
      out[*own].push_back(turns[i]);
    }
    return out;
  }

  // Runs one process, and after each death in a detector another one without that detector.
  SceneAnswer run_process() {
    const std::string name = task_.id + "." + std::to_string(processes_++);
    job_.answer_file = scratch_ / (name + ".answer");
    const fs::path job_file = scratch_ / (name + ".job");
    // Judging and each pass count alike.
    const double parts =
        job_.settings.timing ? 1.0 + static_cast<double>(job_.settings.processes) : 1.0;
    const auto report = [&](WorkerProgress worker) {
      worker.share = (done_ + part_ * worker.share) / parts;
      on_progress_(worker);
    };
    while (true) {
      std::erase_if(job_.turns, [&](const Turn& turn) { return broken_.contains(turn.position); });
      if (job_.turns.empty() && processes_ > 1) return {};
      job_.temporary = scratch_ / (name + ".tmp");
      fs::create_directory(job_.temporary);
      write_job(job_file, job_);
      RunSettings limits = job_.settings;
      if (limits.timing) limits.memory_limit += timing::sweep_bytes();  // which is ours
      const WorkerOutcome outcome = run_supervised(request_.executable, job_file, limits, report);
      std::error_code ignored;
      fs::remove_all(job_.temporary, ignored);
      if (outcome.done) return read_answer(job_.answer_file);
      book(outcome);
    }
  }

  void book(const WorkerOutcome& outcome) {
    // It costs its scene, not the run: a frame may hold more work than the limits allow. Random
    // pairs are made to be judged, and a process that only times does not judge.
    const bool before_detectors = outcome.over_limit && !outcome.detector &&
                                  !outcome.last_detector && job_.turns.empty() && !job_.unjudged;
    auto* const drawn = std::get_if<scene::DrawnSpec>(&job_.scene);
    if (before_detectors && drawn != nullptr && drawn->redrawn < scene::kMostRedraws) {
      ++drawn->redrawn;
      return;
    }
    const bool unmade = drawn != nullptr && outcome.phase == process::Phase::kScene;
    if (before_detectors && (outcome.phase == process::Phase::kTruth || unmade) &&
        !std::holds_alternative<scene::PairSpec>(job_.scene)) {
      std::string why = place_of(task_.id, outcome) + ", before any detector: ";
      why += unmade ? "this scene cannot be made" : "the oracle cannot judge this scene";
      if (drawn != nullptr)
        why += ", like the " + std::to_string(drawn->redrawn) + " drawn in its place before";
      job_.unjudged = Unjudged{why, outcome.frame};
      return;
    }
    // The detector that ran; or, where the suite's own code died in a way that is not its own, the
    // one that had run last: what a library has overwritten in memory strikes later.
    const bool by_itself =
        outcome.exit_code == process::kExitBadInput || outcome.exit_code == process::kExitInternal;
    const std::optional<std::uint32_t> suspect =
        outcome.detector || by_itself ? outcome.detector : outcome.last_detector;
    // One that did not run again cannot have died again: then the worker's page is no witness.
    if (!suspect || broken_.contains(*suspect)) throw_for_scene(outcome);
    show_last_words(task_.detectors[*suspect], outcome.error_text);
    broken_[*suspect] = outcome;
    job_.skip.push_back(*suspect);
  }

  // All of it: of a sanitizer's report the first line says little.
  void show_last_words(const std::string& detector, const std::string& text) const {
    if (text.empty()) return;
    std::fprintf(stderr, "contactcheck: scene %s, detector %s: the worker's last words:\n",
                 task_.id.c_str(), detector.c_str());
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      std::fprintf(stderr, "  | %s\n", text::printable_line(line).c_str());
  }

  [[noreturn]] void throw_for_scene(const WorkerOutcome& outcome) const {
    const std::string words = text::printable_line(outcome.error_text);
    const std::string what = "scene \"" + task_.id + "\" ended in " + outcome.reason + ", phase " +
                             process::name_of(outcome.phase) + ", frame " +
                             std::to_string(outcome.frame) + ", outside any detector" +
                             (words.empty() ? "" : ": " + words);
    // The input's fault: a scene file that changed under our feet.
    if (outcome.exit_code == process::kExitBadInput) throw InputError(what);
    throw std::runtime_error(what);
  }

  const SuiteRequest& request_;
  const SceneTask& task_;
  const fs::path& scratch_;
  const ProgressCallback& on_progress_;
  Job job_;
  std::size_t processes_ = 0;       ///< that were started
  double done_ = 0.0, part_ = 1.0;  ///< parts of the work: done, and of the process that runs
  TakenTurns turns_;
  std::set<std::uint32_t> slow_;  ///< detectors that have one pass
  BrokenDetectors broken_;
};

}  // namespace

FinishedScene run_scene(const SuiteRequest& request, const SceneTask& task, const fs::path& scratch,
                        const SuiteListener& listener, const ProgressCallback& on_progress) {
  return SceneRun(request, task, scratch, on_progress).finish(listener.samples);
}

}  // namespace contactcheck::suite
