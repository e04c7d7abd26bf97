#include "reference/run/scene_run.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "core/types/check.h"
#include "core/types/hash.h"
#include "reference/run/cache_sweep.h"
#include "reference/run/exit_codes.h"
#include "reference/run/printable.h"
#include "reference/run/scene_answers.h"
#include "reference/run/schedule.h"
#include "reference/run/worker.h"

namespace contactcheck {
namespace {

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
    if (!task.file.empty()) job_.scene_file = fs::absolute(task.file);
    job_.pairs = task.pairs;
    job_.text = task.text;
    if (job_.text) job_.text->folder = fs::absolute(task.text->folder);
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
    return put_together({task_, judged, turns_, job_.cold_frames, broken_, recorded},
                        listener_.samples);
  }

 private:
  void time(const SceneAnswer& judged) {
    const RunSettings& s = job_.settings;
    for (std::size_t pass = 0; pass < s.processes; ++pass) {
      std::vector<std::vector<Turn>> processes = processes_of(judged, pass);
      if (processes.empty()) return;
      if (pass == 0) job_.cold_frames = draw_cold_frames(judged.contact_frames, s.seed);
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
    for (const std::size_t i : draw_order(turns.size(), order_seed(pass))) {
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
      if (limits.timing) limits.memory_limit += sweep_bytes();  // which is ours
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
    const bool by_itself = outcome.exit_code == kExitBadInput || outcome.exit_code == kExitInternal;
    return outcome.detector || by_itself ? outcome.detector : outcome.last_detector;
  }

  // It costs its scene, not the run: a frame may hold more work than the limits allow. Random pairs
  // are made to be judged, and a process that only times does not judge.
  bool is_too_much_to_judge(const WorkerOutcome& outcome) const {
    return outcome.over_limit && outcome.phase == Phase::kTruth && !outcome.last_detector &&
           job_.turns.empty() && !job_.pairs && !job_.unjudged;
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
      std::fprintf(stderr, "  | %s\n", printable_line(line).c_str());
  }

  [[noreturn]] void throw_for_scene(const WorkerOutcome& outcome) const {
    const std::string words = printable_line(outcome.error_text);
    const std::string what = "scene \"" + task_.id + "\" ended in " + outcome.reason + ", phase " +
                             name_of(outcome.phase) + ", frame " + std::to_string(outcome.frame) +
                             ", outside any detector" + (words.empty() ? "" : ": " + words);
    // The input's fault: a scene file that changed under our feet.
    if (outcome.exit_code == kExitBadInput) throw InputError(what);
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

}  // namespace contactcheck
