#include "reference/run/scene_answers.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reference/compare/run_result_json.h"
#include "reference/compare/speedup.h"
#include "reference/results/references.h"
#include "reference/run/contacts_json.h"
#include "reference/run/samples_json.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

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

// Collects the detectors of all processes, the judging one's first.
class Assembly {
 public:
  explicit Assembly(const SceneAnswers& scene) : scene_(scene) {
    for (const Json& answer : scene.answers) add(answer);
  }

  Json disagreements() const {
    Json out = first().at("oracle_disagreements");
    for (const Json& d : disagreements_) out.push_back(d);
    return out;
  }

  Json rows(const SampleListener& tell) {
    const auto contact = first().at("contact_frames").get<std::vector<bool>>();
    for (auto& [position, run] : runs_)
      if (samples_.count(position)) add_times(times_of(position, contact), run);
    for (const auto& [position, questions] : samples_)
      for (const ProcessSamples& question : questions)
        tell(task().id, task().detectors[position], question);
    add_reference_options();
    Json out = Json::array();
    for (std::uint32_t i = 0; i < task().detectors.size(); ++i)
      out.push_back(scene_.broken.count(i) ? broken_row(i) : std::move(runs_.at(i)));
    return out;
  }

  // Of those whose answers count: one that broke later, in another process, has no contacts either.
  Json judged_contacts(const Json& runs) const {
    Json detectors = Json::array();
    for (const Json& entry : first().at("runs")) {
      const Json& run = runs.at(entry.at("position").get<std::size_t>());
      if (run.at("status") == name_of(RunStatus::kOk) && !entry.at("contacts").is_null())
        detectors.push_back(entry.at("contacts"));
    }
    return detectors;
  }

 private:
  // A speed-up says against which options of the reference it was measured.
  void add_reference_options() {
    for (auto& [position, run] : runs_) {
      if (!run.contains("speedup")) continue;
      for (auto& by_reference : run["speedup"])
        for (auto& [name, speedup] : by_reference.items())
          for (const auto& [other, reference] : runs_)
            if (task().detectors[other] == name)
              speedup["reference_options"] = reference.at("options");
    }
  }

  void add(const Json& answer) {
    for (const Json& entry : answer.at("runs")) {
      const auto position = entry.at("position").get<std::uint32_t>();
      if (scene_.broken.count(position)) continue;
      const bool judged = &answer == &first();
      if (!judged && !carries_on(entry.at("run"), runs_.at(position))) {
        samples_.erase(position);
        continue;
      }
      add_samples(position, entry.at("samples"));
      if (judged) add_judged(position, entry);
    }
  }

  void add_samples(std::uint32_t position, const Json& questions) {
    if (questions.empty()) {
      samples_.erase(position);
      return;
    }
    std::vector<ProcessSamples>& by_question = samples_[position];
    by_question.resize(questions.size());
    for (std::size_t q = 0; q < questions.size(); ++q)
      by_question[q].push_back(samples_from_json(questions[q]));
  }

  void add_judged(std::uint32_t position, const Json& entry) {
    runs_[position] = entry.at("run");
    if (scene_.recorded) runs_[position]["recording"] = "recordings/" + task().id + ".ccr";
    for (const Json& d : entry.at("disagreements")) disagreements_.push_back(d);
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

  RunTimes times_of(std::uint32_t position, const std::vector<bool>& contact) const {
    RunTimes times;
    const std::vector<ProcessSamples>& own = samples_.at(position);
    times.cold_frame_ms = cold_frame_ms(own.front());
    for (const ProcessSamples& question : own) {
      times.questions.push_back(summarize_times(question, contact));
      for (const auto& [other, theirs] : samples_) {
        const bool contacts = question.front().question == Question::kContacts;
        if (contacts &&
            !same_contacts(runs_.at(position).at("semantics"), runs_.at(other).at("semantics")))
          continue;
        add_speedups(other, theirs, question, contact, times);
      }
    }
    return times;
  }

  bool is_reference(const std::string& name) const {
    return std::find(std::begin(kReferences), std::end(kReferences), name) !=
               std::end(kReferences) ||
           std::find(task().references.begin(), task().references.end(), name) !=
               task().references.end();
  }

  void add_speedups(std::uint32_t other, const std::vector<ProcessSamples>& theirs,
                    const ProcessSamples& own, const std::vector<bool>& contact,
                    RunTimes& times) const {
    const std::string& name = task().detectors[other];
    if (!is_reference(name)) return;
    for (const ProcessSamples& reference : theirs) {
      if (reference.front().question != own.front().question) continue;
      if (const auto s = compute_speedup(reference, own, contact))
        times.speedups[own.front().question][name] = *s;
    }
  }

  Json broken_row(std::uint32_t position) const {
    const WorkerOutcome& o = scene_.broken.at(position);
    RunResult run;
    run.scene = task().id;
    run.detector = task().detectors[position];
    run.status = RunStatus::kError;
    run.failed_frame = o.frame;
    run.message = place_of(task().id, o) +
                  (o.detector ? "" : " in the suite's own code, after this detector had run");
    run.frames = first().at("scene").at("frames").get<std::size_t>();
    run.contact_frames = first().at("scene").at("contact_frames").get<std::size_t>();
    return to_json(run);
  }

  const Json& first() const { return scene_.answers.front(); }
  const SceneTask& task() const { return scene_.task; }

  const SceneAnswers& scene_;
  std::map<std::uint32_t, Json> runs_;
  std::map<std::uint32_t, std::vector<ProcessSamples>> samples_;
  Json disagreements_ = Json::array();
};

}  // namespace

std::string place_of(const std::string& scene, const WorkerOutcome& outcome) {
  return place_text(scene, outcome.frame, outcome.phase) + ": " + outcome.reason;
}

FinishedScene put_together(const SceneAnswers& scene, const SampleListener& tell) {
  const Json& first = scene.answers.front();
  Assembly assembly(scene);
  FinishedScene finished;
  finished.scene = first.at("scene");
  finished.disagreements = assembly.disagreements();
  finished.runs = assembly.rows(tell);
  if (!first.contains("truth_contacts")) return finished;
  finished.scene["contacts"] = contacts_path(scene.task.id);
  finished.contacts = contacts_text(scene.task.id, first.at("truth_contacts"),
                                    assembly.judged_contacts(finished.runs));
  return finished;
}

}  // namespace contactcheck
