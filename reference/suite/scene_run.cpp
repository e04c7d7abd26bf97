#include "reference/suite/scene_run.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/types/check.h"
#include "core/types/hash.h"
#include "reference/process/exit_codes.h"
#include "reference/scene/drawn_scene.h"
#include "reference/suite/scene_rows.h"
#include "reference/suite/supervisor.h"
#include "reference/suite/worker.h"
#include "reference/text/printable.h"
#include "reference/timing/schedule.h"
#include "reference/timing/speedup.h"

namespace contactcheck::suite {
namespace {

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
      if (std::ranges::count(job_.settings.plugin_ids, name.substr(0, name.find(':'))) > 0) {
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
      const WorkerOutcome outcome =
          run_supervised(request_.executable, job_file, job_.settings, report);
      std::error_code ignored;
      fs::remove_all(job_.temporary, ignored);
      if (outcome.done) return read_answer(job_.answer_file);
      take_note(outcome);
    }
  }

  // Decides what the next process does differently.
  void take_note(const WorkerOutcome& outcome) {
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
    // One that did not run again cannot have died again: then the worker's page is no evidence.
    if (!suspect || broken_.contains(*suspect)) throw_for_scene(outcome);
    show_last_words(task_.detectors[*suspect], outcome.error_text);
    broken_[*suspect] = outcome;
    broken_[*suspect].timed = !job_.turns.empty();
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
