#include "reference/run/scene_run.h"

#include <cstdio>
#include <map>
#include <sstream>
#include <stdexcept>

#include "core/types/check.h"
#include "reference/run/exit_codes.h"
#include "reference/run/printable.h"
#include "reference/run/scene_answers.h"
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
    std::vector<SceneAnswer> answers;
    answers.push_back(run_process(0));
    job_.recording_file.clear();
    job_.order = answers.front().order;
    job_.prefixes = answers.front().prefixes;
    job_.answers.resize(task_.detectors.size());  // of those that broke the process: none
    for (const DetectorAnswer& detector : answers.front().detectors)
      job_.answers.at(detector.position) = detector.answers;
    for (std::size_t p = 1; p < job_.settings.processes && job_.settings.timing; ++p)
      answers.push_back(run_process(p));
    const bool recorded = !answers.front().truth_contacts.empty() && fs::exists(recording);
    return put_together({task_, answers, broken_, recorded}, listener_.samples);
  }

 private:
  // Runs one process; whoever dies in a detector runs again without it.
  SceneAnswer run_process(std::size_t process) {
    job_.process = process;
    job_.answer_file = scratch_ / (task_.id + "." + std::to_string(process) + ".answer");
    const fs::path job_file = scratch_ / (task_.id + "." + std::to_string(process) + ".job");
    while (true) {
      write_job(job_file, job_);
      const WorkerOutcome outcome =
          run_supervised(request_.executable, job_file, job_.settings,
                         [&](const WorkerProgress& worker) { report(process, worker); });
      if (outcome.done) return read_answer(job_.answer_file);
      book(outcome);
    }
  }

  // All processes together are the scene's work.
  void report(std::size_t process, WorkerProgress worker) const {
    const std::size_t processes = job_.settings.timing ? job_.settings.processes : 1;
    worker.share = (static_cast<double>(process) + worker.share) / static_cast<double>(processes);
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
           job_.process == 0 && !job_.pairs && !job_.unjudged;
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
  BrokenDetectors broken_;
};

}  // namespace

FinishedScene run_scene(const SuiteRequest& request, const SceneTask& task, const fs::path& scratch,
                        const SuiteListener& listener, const ProgressCallback& on_progress) {
  return SceneRun(request, task, scratch, listener, on_progress).finish();
}

}  // namespace contactcheck
