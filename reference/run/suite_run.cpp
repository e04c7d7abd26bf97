#include "reference/run/suite_run.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "core/types/check.h"
#include "reference/adapters/register.h"
#include "reference/compare/run_result_json.h"
#include "reference/compare/speedup.h"
#include "reference/run/contacts_json.h"
#include "reference/run/machine.h"
#include "reference/run/out_folder.h"
#include "reference/run/partial_results.h"
#include "reference/run/printable.h"
#include "reference/run/run_identity.h"
#include "reference/run/samples_json.h"
#include "reference/run/shard_record.h"
#include "reference/run/suite_output.h"
#include "reference/run/supervisor.h"
#include "reference/run/worker.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

// Detectors that speed-ups are given against, where the run has them.
constexpr const char* kReferences[] = {"fcl-aabb", "fcl-obbrss", "embree"};

// Contacts are the same question only where they are of one kind: depth of vertices, of triangles
// or of boxes.
bool same_contacts(const Json& semantics, const Json& other) {
  const auto of_triangles = [](const Json& s) {
    const Json& levels = s.at("levels");
    return std::find(levels.begin(), levels.end(), name_of(Level::kTriangle)) != levels.end();
  };
  return semantics.at("depth_kind") == other.at("depth_kind") &&
         of_triangles(semantics) == of_triangles(other);
}

/// All workers of one scene.
class SceneRunner {
 public:
  SceneRunner(const SuiteRequest& request, const SceneTask& task, const fs::path& scratch,
              const SuiteListener& listener, ProgressCallback on_progress)
      : request_(request),
        task_(task),
        scratch_(scratch),
        listener_(listener),
        on_progress_(std::move(on_progress)) {
    // The worker's working directory is for libraries to change.
    if (!task.file.empty()) job_.scene_file = fs::absolute(task.file);
    job_.pairs = task.pairs;
    job_.text = task.text;
    if (job_.text) job_.text->folder = fs::absolute(task.text->folder);
    job_.settings = request.settings;
    job_.settings.detectors = task.detectors;
  }

  /// Runs are in the order of the detectors.
  FinishedScene run() {
    job_.recording_file = fs::absolute(recording());
    const Json first = run_process(0);
    job_.recording_file.clear();
    job_.order = first.at("order").get<std::vector<std::size_t>>();
    job_.prefixes = first.at("prefixes").get<std::vector<std::size_t>>();
    std::vector<Json> answers = {first};
    for (std::size_t p = 1; p < job_.settings.processes && job_.settings.timing; ++p)
      answers.push_back(run_process(p));
    FinishedScene finished;
    finished.scene = first.at("scene");
    for (const Json& d : first.at("oracle_disagreements")) finished.disagreements.push_back(d);
    finished.runs = assemble(answers, finished.disagreements);
    if (!first.contains("truth_contacts")) return finished;
    finished.scene["contacts"] = contacts_path(task_.id);
    finished.contacts =
        contacts_text(task_.id, first.at("truth_contacts"), judged_contacts(first, finished.runs));
    return finished;
  }

 private:
  // Runs one process; whoever dies in a detector runs again without it.
  Json run_process(std::size_t process) {
    job_.process = process;
    job_.answer_file = scratch_ / (task_.id + "." + std::to_string(process) + ".answer");
    const fs::path job_file = scratch_ / (task_.id + "." + std::to_string(process) + ".job");
    while (true) {
      write_job(job_file, job_);
      const WorkerOutcome outcome =
          run_supervised(request_.executable, job_file, job_.settings,
                         [&](const WorkerProgress& worker) { report(process, worker); });
      if (outcome.done) return Json::parse(read_text_file(job_.answer_file));
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

  void book(const WorkerOutcome& outcome) {
    const std::optional<std::uint32_t> detector = suspect(outcome);
    // One that did not run again cannot have died again: then the worker's page is no witness.
    if (!detector || broken_.count(*detector)) throw_for_scene(outcome);
    show_last_words(task_.detectors[*detector], outcome.error_text);
    broken_[*detector] = outcome;
    job_.skip.push_back(*detector);
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

  Json assemble(const std::vector<Json>& answers, Json& disagreements) {
    std::map<std::uint32_t, Json> runs;
    std::map<std::uint32_t, std::vector<ProcessSamples>> samples;
    collect(answers, runs, samples, disagreements);
    const auto contact = answers.front().at("contact_frames").get<std::vector<bool>>();
    for (auto& [position, run] : runs)
      if (samples.count(position)) add_times(times_of(position, runs, samples, contact), run);
    for (const auto& [position, questions] : samples)
      for (const ProcessSamples& question : questions)
        listener_.samples(task_.id, task_.detectors[position], question);
    add_reference_options(runs);
    Json out = Json::array();
    for (std::uint32_t i = 0; i < task_.detectors.size(); ++i)
      out.push_back(broken_.count(i) ? broken_run(i, answers.front()) : std::move(runs.at(i)));
    return out;
  }

  // A speed-up says against which options of the reference it was measured.
  void add_reference_options(std::map<std::uint32_t, Json>& runs) const {
    for (auto& [position, run] : runs) {
      if (!run.contains("speedup")) continue;
      for (auto& by_reference : run["speedup"])
        for (auto& [name, speedup] : by_reference.items())
          for (const auto& [other, reference] : runs)
            if (task_.detectors[other] == name)
              speedup["reference_options"] = reference.at("options");
    }
  }

  void collect(const std::vector<Json>& answers, std::map<std::uint32_t, Json>& runs,
               std::map<std::uint32_t, std::vector<ProcessSamples>>& samples, Json& disagreements) {
    for (const Json& answer : answers) {
      for (const Json& entry : answer.at("runs")) {
        const auto position = entry.at("position").get<std::uint32_t>();
        if (broken_.count(position)) continue;
        const bool judged = &answer == &answers.front();
        if (!judged && !carries_on(entry.at("run"), runs.at(position))) {
          samples.erase(position);
          continue;
        }
        std::vector<ProcessSamples>& by_question = samples[position];
        by_question.resize(entry.at("samples").size());
        for (std::size_t q = 0; q < entry.at("samples").size(); ++q)
          by_question[q].push_back(samples_from_json(entry.at("samples")[q]));
        if (by_question.empty()) samples.erase(position);
        if (!judged) continue;
        runs[position] = entry.at("run");
        if (fs::exists(recording()))
          runs[position]["recording"] = "recordings/" + task_.id + ".ccr";
        for (const Json& d : entry.at("disagreements")) disagreements.push_back(d);
      }
    }
  }

  // Did a detector that worked in the first process work in a later one too? Otherwise its result
  // becomes that one's.
  static bool carries_on(const Json& later, Json& run) {
    const char* const ok = name_of(RunStatus::kOk);
    if (run.at("status") == ok && later.at("status") != ok) {
      const Json contact_frames = run.at("contact_frames");
      run = later;
      run["contact_frames"] = contact_frames;
    }
    return run.at("status") == ok;
  }

  fs::path recording() const { return request_.out / "recordings" / (task_.id + ".ccr"); }

  RunTimes times_of(std::uint32_t position, const std::map<std::uint32_t, Json>& runs,
                    const std::map<std::uint32_t, std::vector<ProcessSamples>>& samples,
                    const std::vector<bool>& contact) const {
    RunTimes times;
    const std::vector<ProcessSamples>& own = samples.at(position);
    times.cold_frame_ms = cold_frame_ms(own.front());
    for (const ProcessSamples& question : own) {
      times.questions.push_back(summarize_times(question, contact));
      for (const auto& [other, theirs] : samples) {
        const bool contacts = question.front().question == Question::kContacts;
        if (contacts &&
            !same_contacts(runs.at(position).at("semantics"), runs.at(other).at("semantics")))
          continue;
        add_speedups(other, theirs, question, contact, times);
      }
    }
    return times;
  }

  bool is_reference(const std::string& name) const {
    return std::find(std::begin(kReferences), std::end(kReferences), name) !=
               std::end(kReferences) ||
           std::find(task_.references.begin(), task_.references.end(), name) !=
               task_.references.end();
  }

  void add_speedups(std::uint32_t other, const std::vector<ProcessSamples>& theirs,
                    const ProcessSamples& own, const std::vector<bool>& contact,
                    RunTimes& times) const {
    const std::string& name = task_.detectors[other];
    if (!is_reference(name)) return;
    for (const ProcessSamples& reference : theirs) {
      if (reference.front().question != own.front().question) continue;
      if (const auto s = compute_speedup(reference, own, contact))
        times.speedups[own.front().question][name] = *s;
    }
  }

  // Of those whose answers count: one that broke later, in another process, has no contacts either.
  static Json judged_contacts(const Json& answer, const Json& runs) {
    Json detectors = Json::array();
    for (const Json& entry : answer.at("runs")) {
      const Json& run = runs.at(entry.at("position").get<std::size_t>());
      if (run.at("status") == name_of(RunStatus::kOk) && !entry.at("contacts").is_null())
        detectors.push_back(entry.at("contacts"));
    }
    return detectors;
  }

  Json broken_run(std::uint32_t position, const Json& answer) const {
    const WorkerOutcome& o = broken_.at(position);
    RunResult run;
    run.scene = task_.id;
    run.detector = task_.detectors[position];
    run.status = RunStatus::kError;
    run.failed_frame = o.frame;
    run.message = "scene " + task_.id + ", frame " + std::to_string(o.frame) + ", phase " +
                  name_of(o.phase) + ": " + o.reason +
                  (o.detector ? "" : " in the suite's own code, after this detector had run");
    run.frames = answer.at("scene").at("frames").get<std::size_t>();
    run.contact_frames = answer.at("scene").at("contact_frames").get<std::size_t>();
    return to_json(run);
  }

  const SuiteRequest& request_;
  const SceneTask& task_;
  fs::path scratch_;
  const SuiteListener& listener_;
  ProgressCallback on_progress_;
  Job job_;
  std::map<std::uint32_t, WorkerOutcome> broken_;
};

// What a run says that has no scene.
SuiteRecord record_of(const SuiteRequest& request, const Json& resumed) {
  SuiteRecord record{{{"schema", "contactcheck-results/1"},
                      {"version", CONTACTCHECK_VERSION},
                      {"command", request.command},
                      {"machine", describe_machine()},
                      {"libraries", library_versions()}},
                     Json::object(),
                     request.goals,
                     request.known_defects,
                     request.shard.has_value()};
  if (!request.plugins.empty()) record.head["plugins"] = Json::parse(request.plugins);
  if (request.resume) record.tail["resumed"] = resumed;
  if (request.shard) record.tail["shard"] = shard_record(request);
  return record;
}

}  // namespace

nlohmann::ordered_json run_suite(const SuiteRequest& request, const SuiteListener& listener,
                                 SuiteOutcome* outcome) {
  make_out_folders(request.out);
  const ScratchFolder scratch(fs::absolute(request.out));
  make_contacts_folder(scratch.path());
  const PartialResults partial(request.out, scratch.path());
  if (!request.resume) partial.clear();
  const RunIdentity identity(request);
  SuiteOutput output(request.out, scratch.path());
  Json resumed = Json::array();
  SuiteProgress progress;
  progress.scenes = request.tasks.size();
  for (; progress.scene < request.tasks.size(); ++progress.scene) {
    const SceneTask& task = request.tasks[progress.scene];
    progress.scene_id = task.id;
    progress.frames = task.frames;
    const auto report = [&](const WorkerProgress& worker) {
      progress.detector = worker.detector ? task.detectors[*worker.detector] : "";
      progress.frame = worker.frame;
      progress.share = (static_cast<double>(progress.scene) + worker.share) /
                       static_cast<double>(progress.scenes);
      listener.progress(progress);
    };
    std::optional<FinishedScene> finished = partial.take(task.id, identity.of(task));
    const bool resumed_now = finished.has_value();
    if (resumed_now) {
      resumed.push_back(task.id);
    } else {
      partial.drop(task.id);  // its recording will be replaced
      report({});
      finished = SceneRunner(request, task, scratch.path(), listener, report).run();
      partial.keep(task.id, identity.of(task), *finished);
    }
    listener.scene_end({task.id, resumed_now, finished->runs});
    output.add(std::move(*finished));
  }
  Json results = output.write(record_of(request, resumed), outcome);
  partial.clear();
  return results;
}

}  // namespace contactcheck
