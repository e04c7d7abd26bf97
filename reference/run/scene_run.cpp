#include "reference/run/scene_run.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <sstream>
#include <stdexcept>

#include "core/types/check.h"
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
    job_.recording_file.clear();
    job_.answers.resize(task_.detectors.size());  // of those that broke the process: none
    for (const DetectorAnswer& detector : judged.detectors)
      job_.answers.at(detector.position) = detector.answers;
    if (job_.settings.timing) time(judged);
    const bool recorded = !judged.truth_contacts.empty() && fs::exists(recording);
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
        turns_.add(run_process().timed);
      }
    }
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
    for (const std::size_t i : draw_order(turns.size(), job_.settings.seed, pass)) {
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

  bool is_timed(const DetectorAnswer& detector, std::size_t pass) const {
    const double limit = job_.settings.one_pass_beyond;
    return detector.run.ok() && !broken_.contains(detector.position) &&
           turns_.failure(detector.position) == nullptr &&
           (pass == 0 || limit == 0.0 ||
            turns_.seconds(detector.position) / static_cast<double>(pass) <= limit);
  }

  bool is_from_outside(std::uint32_t position) const {
    const std::string& name = task_.detectors[position];
    return std::any_of(request_.plugins.begin(), request_.plugins.end(),
                       [&](const results::Plugin& plugin) {
                         return plugin.detector == name.substr(0, name.find(':'));
                       });
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
      const WorkerOutcome outcome =
          run_supervised(request_.executable, job_file, job_.settings,
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
  BrokenDetectors broken_;
};

}  // namespace

FinishedScene run_scene(const SuiteRequest& request, const SceneTask& task, const fs::path& scratch,
                        const SuiteListener& listener, const ProgressCallback& on_progress) {
  return SceneRun(request, task, scratch, listener, on_progress).finish();
}

}  // namespace contactcheck
