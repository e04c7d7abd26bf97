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
#include "reference/suite/partial_results.h"
#include "reference/suite/suite_run.h"
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
  std::vector<timing::QuestionSamples> samples(std::uint32_t position,
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

bool contains(const std::vector<std::string>& notes, const std::string& note) {
  return std::find(notes.begin(), notes.end(), note) != notes.end();
}

// Contacts are the same question only where they are of one kind: depth of vertices, of triangles
// or of boxes.
bool same_contacts(const Semantics& semantics, const Semantics& other) {
  const auto of_triangles = [](const Semantics& s) {
    return std::find(s.levels.begin(), s.levels.end(), Level::kTriangle) != s.levels.end();
  };
  return semantics.depth == other.depth && of_triangles(semantics) == of_triangles(other);
}

// The rows of the process that judged, and what later processes say of them.
class Rows {
 public:
  explicit Rows(const SceneAnswers& scene) : scene_(scene) {
    for (const DetectorAnswer& detector : scene.judged.detectors)
      if (!scene.broken.contains(detector.position)) add(detector);
  }

  // One per detector of the task.
  std::vector<results::Run> finish(const SampleListener& tell) {
    for (auto& [position, run] : runs_)
      if (samples_.contains(position)) add_times(position, run);
    for (const auto& [position, questions] : samples_)
      for (const timing::QuestionSamples& question : questions)
        tell(task().id, task().detectors[position], question);
    std::vector<results::Run> out;
    for (std::uint32_t i = 0; i < task().detectors.size(); ++i) {
      if (scene_.broken.contains(i)) {
        out.push_back(broken_row(i));
      } else {
        out.push_back(std::move(runs_.at(i)));
      }
    }
    return out;
  }

 private:
  void add(const DetectorAnswer& detector) {
    const std::uint32_t position = detector.position;
    results::Run& run = runs_[position] = detector.run;
    if (scene_.recorded) run.recording = "recordings/" + task().id + ".ccr";
    for (const std::string& note : scene_.turns.notes(position))
      if (!contains(detector.run.notes, note)) run.notes.push_back(note + " (while timed)");
    if (!run.ok()) return;
    if (const TurnAnswer* failed = scene_.turns.failure(position)) {
      // It was judged well and fails now: that is its result.
      run.status = results::Status::kError;
      run.message = failed->error;
      run.failed_frame = failed->failed_frame;
      return;
    }
    std::vector<timing::QuestionSamples> samples =
        scene_.turns.samples(position, run.semantics.questions);
    if (!samples.empty()) samples_[position] = std::move(samples);
  }

  void add_times(std::uint32_t position, results::Run& run) const {
    const timing::TimedFrames frames = {scene_.judged.contact_frames, scene_.cold_frames};
    const std::vector<timing::QuestionSamples>& own = samples_.at(position);
    run.per_frame.frame_ms = timing::frame_ms(own.front());
    for (const timing::QuestionSamples& question : own) {
      run.times.push_back(timing::summarize_times(question, frames));
      for (const auto& [other, theirs] : samples_)
        if (is_reference(task().detectors[other])) add_speedup(other, theirs, question, run);
    }
  }

  void add_speedup(std::uint32_t other, const std::vector<timing::QuestionSamples>& theirs,
                   const timing::QuestionSamples& own, results::Run& run) const {
    const results::Run& reference = runs_.at(other);
    if (own.question == Question::kContacts && !same_contacts(run.semantics, reference.semantics))
      return;
    for (const timing::QuestionSamples& samples : theirs) {
      if (samples.question != own.question) continue;
      results::Speedup speedup =
          timing::compute_speedup(samples, own, {scene_.judged.contact_frames, scene_.cold_frames});
      speedup.reference_options = reference.options;
      run.speedup[own.question][task().detectors[other]] = std::move(speedup);
    }
  }

  bool is_reference(const std::string& name) const {
    return std::find(std::begin(results::kReferences), std::end(results::kReferences), name) !=
               std::end(results::kReferences) ||
           std::find(task().references.begin(), task().references.end(), name) !=
               task().references.end();
  }

  results::Run broken_row(std::uint32_t position) const {
    const WorkerOutcome& o = scene_.broken.at(position);
    results::Run run;
    run.scene = task().id;
    run.detector = task().detectors[position];
    run.status = results::Status::kError;
    run.failed_frame = o.frame;
    run.message = place_of(task().id, o) +
                  (o.detector ? "" : " in the suite's own code, after this detector had run");
    run.frames = scene_.judged.scene.frames;
    run.contact_frames = scene_.judged.scene.contact_frames;
    return run;
  }

  const SceneTask& task() const { return scene_.task; }

  const SceneAnswers& scene_;
  std::map<std::uint32_t, results::Run> runs_;
  std::map<std::uint32_t, std::vector<timing::QuestionSamples>> samples_;
};

void TakenTurns::add(const std::vector<TurnAnswer>& answers) {
  for (const TurnAnswer& answer : answers) turns_[answer.turn.position].push_back(answer);
}

double TakenTurns::seconds(std::uint32_t position) const {
  double nanoseconds = 0.0;
  if (const auto found = turns_.find(position); found != turns_.end())
    for (const TurnAnswer& answer : found->second)
      for (const timing::PhaseSample& frame : answer.samples)
        if (!answer.turn.cold) nanoseconds += frame.total();
  return 1e-9 * nanoseconds;
}

const TurnAnswer* TakenTurns::failure(std::uint32_t position) const {
  if (const auto found = turns_.find(position); found != turns_.end())
    for (const TurnAnswer& answer : found->second)
      if (!answer.error.empty()) return &answer;
  return nullptr;
}

std::vector<std::string> TakenTurns::notes(std::uint32_t position) const {
  std::vector<std::string> out;
  if (const auto found = turns_.find(position); found != turns_.end())
    for (const TurnAnswer& answer : found->second)
      for (const std::string& note : answer.notes)
        if (!contains(out, note)) out.push_back(note);
  return out;
}

std::vector<timing::QuestionSamples> TakenTurns::samples(
    std::uint32_t position, const std::vector<Question>& questions) const {
  std::vector<timing::QuestionSamples> out;
  const auto found = turns_.find(position);
  if (found == turns_.end()) return out;
  for (const Question question : questions) {
    timing::QuestionSamples& samples = out.emplace_back();
    samples.question = question;
    for (const TurnAnswer& answer : found->second) {
      if (answer.turn.question != question) continue;
      samples.lazy_map = answer.lazy_map;
      (answer.turn.cold ? samples.cold : samples.playback).push_back(answer.samples);
    }
  }
  return out;
}

// The scene with one row per detector, in the task's order. A detector that broke a worker, or
// was judged well and fails in a turn, has an error's row and no times. `tell` is given each
// detector's samples before they are summed up.
FinishedScene assemble(const SceneAnswers& scene, const SampleListener& tell) {
  const SceneAnswer& first = scene.judged;
  const std::vector<std::string>& names = scene.task.detectors;
  FinishedScene finished;
  finished.scene = first.scene;
  finished.scene.cold_frames = scene.cold_frames;
  finished.runs = Rows(scene).finish(tell);
  for (const results::Disagreement& d : first.disagreements) {
    const auto broke = [&](const auto& broken) { return names[broken.first] == d.detector; };
    if (std::none_of(scene.broken.begin(), scene.broken.end(), broke))
      finished.disagreements.push_back(d);
  }
  if (first.truth_contacts.empty()) return finished;
  // Of those whose answers count: one that broke later, in another process, has no contacts either.
  std::vector<std::string> contacts;
  for (const DetectorAnswer& detector : first.detectors)
    if (finished.runs.at(detector.position).ok() && !detector.contacts.empty())
      contacts.push_back(detector.contacts);
  finished.scene.contacts = judge::contacts_path(scene.task.id);
  finished.contacts = judge::contacts_text(scene.task.id, first.truth_contacts, contacts);
  return finished;
}

namespace fs = std::filesystem;

class SceneRun {
 public:
  SceneRun(const SuiteRequest& request, const SceneTask& task, const fs::path& scratch,
           const SuiteListener& listener, const ProgressCallback& on_progress)
      : request_(request),
        task_(task),
        scratch_(scratch),
        listener_(listener),
        on_progress_(on_progress) {
    // The worker's working directory is for libraries to change.
    job_.scene = scene::absolute(task.source);
    job_.settings = request.settings;
    job_.settings.detectors = task.detectors;
  }

  FinishedScene finish() {
    const fs::path recording = request_.out / "recordings" / (task_.id + ".ccr");
    job_.recording_file = fs::absolute(recording);
    const SceneAnswer judged = run_process();
    const bool recorded = !judged.truth_contacts.empty() && fs::exists(recording);
    if (!recorded) job_.recording_file.clear();  // there may be one of an earlier run
    if (job_.settings.timing) time(judged);
    return assemble({task_, judged, turns_, job_.cold_frames, broken_, recorded},
                    listener_.samples);
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
        hand_answers_over(judged);
        turns_.add(run_process().timed);
      }
      if (pass == 0) find_slow_ones(judged);
    }
  }

  // What was judged, of the detectors that have a turn: of all together it is long.
  void hand_answers_over(const SceneAnswer& judged) {
    job_.answers.assign(task_.detectors.size(), {});
    for (const DetectorAnswer& detector : judged.detectors)
      if (std::any_of(job_.turns.begin(), job_.turns.end(),
                      [&](const Turn& turn) { return turn.position == detector.position; }))
        job_.answers.at(detector.position) = detector.answers;
  }

  // The turns of one pass in an order drawn by seed, by the process that takes them: each turn of a
  // detector from outside has one for itself, since what it keeps in memory is out of our hands.
  std::vector<std::vector<Turn>> processes_of(const SceneAnswer& judged, std::size_t pass) const {
    std::vector<Turn> turns;
    for (const DetectorAnswer& detector : judged.detectors) {
      if (!is_timed(detector, pass)) continue;
      const std::vector<Question>& questions = detector.run.semantics.questions;
      for (const Question question : questions)
        turns.push_back({detector.position, question, false});
      turns.push_back({detector.position, questions.front(), true});
    }
    std::vector<std::vector<Turn>> out;
    std::optional<std::size_t> own;  // the process of our detectors
    for (const std::size_t i : timing::draw_order(turns.size(), order_seed(pass))) {
      if (is_from_outside(turns[i].position)) {
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

  // By the first pass alone: pass p of one detector is set beside pass p of another.
  void find_slow_ones(const SceneAnswer& judged) {
    const double limit = job_.settings.one_pass_beyond;
    if (limit == 0.0) return;
    for (const DetectorAnswer& detector : judged.detectors)
      if (turns_.seconds(detector.position) > limit) slow_.insert(detector.position);
  }

  bool is_timed(const DetectorAnswer& detector, std::size_t pass) const {
    const std::uint32_t position = detector.position;
    return detector.run.ok() && !broken_.contains(position) &&
           turns_.failure(position) == nullptr && (pass == 0 || !slow_.contains(position));
  }

  // Another one in every scene, or one detector would always follow the same other.
  std::uint64_t order_seed(std::size_t pass) const {
    Fnv1a hash;
    hash.bytes(task_.id.data(), task_.id.size());
    const std::uint64_t numbers[] = {job_.settings.seed, pass};
    hash.bytes(numbers, sizeof numbers);
    return hash.digest();
  }

  bool is_from_outside(std::uint32_t position) const {
    const std::vector<std::string>& ids = job_.settings.plugin_ids;
    const std::string& name = task_.detectors[position];
    return std::find(ids.begin(), ids.end(), name.substr(0, name.find(':'))) != ids.end();
  }

  // Runs one process; whoever dies in a detector runs again without it.
  SceneAnswer run_process() {
    const std::string name = task_.id + "." + std::to_string(processes_++);
    job_.answer_file = scratch_ / (name + ".answer");
    const fs::path job_file = scratch_ / (name + ".job");
    while (true) {
      std::erase_if(job_.turns, [&](const Turn& turn) { return broken_.contains(turn.position); });
      if (job_.turns.empty() && processes_ > 1) return {};
      job_.temporary = scratch_ / (name + ".tmp");
      fs::create_directory(job_.temporary);
      write_job(job_file, job_);
      RunSettings limits = job_.settings;
      if (limits.timing) limits.memory_limit += timing::sweep_bytes();  // which is ours
      const WorkerOutcome outcome =
          run_supervised(request_.executable, job_file, limits,
                         [&](const WorkerProgress& worker) { report(worker); });
      std::error_code ignored;
      fs::remove_all(job_.temporary, ignored);
      if (outcome.done) return read_answer(job_.answer_file);
      book(outcome);
    }
  }

  // Judging and each pass count alike.
  void report(WorkerProgress worker) const {
    const double parts =
        job_.settings.timing ? 1.0 + static_cast<double>(job_.settings.processes) : 1.0;
    worker.share = (done_ + part_ * worker.share) / parts;
    on_progress_(worker);
  }

  // The detector that ran; or, where the suite's own code died in a way that is not its own, the
  // one that had run last: what a library has overwritten in memory strikes later.
  static std::optional<std::uint32_t> suspect(const WorkerOutcome& outcome) {
    const bool by_itself =
        outcome.exit_code == process::kExitBadInput || outcome.exit_code == process::kExitInternal;
    return outcome.detector || by_itself ? outcome.detector : outcome.last_detector;
  }

  // It costs its scene, not the run: a frame may hold more work than the limits allow. Random pairs
  // are made to be judged, and a process that only times does not judge.
  bool is_too_much_to_judge(const WorkerOutcome& outcome) const {
    return outcome.over_limit && outcome.phase == process::Phase::kTruth &&
           !outcome.last_detector && job_.turns.empty() && !job_.unjudged &&
           !std::holds_alternative<scene::PairSpec>(job_.scene);
  }

  void book(const WorkerOutcome& outcome) {
    if (is_too_much_to_judge(outcome)) {
      leave_unjudged(outcome);
      return;
    }
    const std::optional<std::uint32_t> detector = suspect(outcome);
    // One that did not run again cannot have died again: then the worker's page is no witness.
    if (!detector || broken_.count(*detector)) throw_for_scene(outcome);
    show_last_words(task_.detectors[*detector], outcome.error_text);
    broken_[*detector] = outcome;
    job_.skip.push_back(*detector);
  }

  void leave_unjudged(const WorkerOutcome& outcome) {
    job_.unjudged = Unjudged{
        place_of(task_.id, outcome) + ", before any detector: the oracle cannot judge this scene",
        outcome.frame};
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
  fs::path scratch_;
  const SuiteListener& listener_;
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
  return SceneRun(request, task, scratch, listener, on_progress).finish();
}

}  // namespace contactcheck::suite
