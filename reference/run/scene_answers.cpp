#include "reference/run/scene_answers.h"

#include <algorithm>

#include "reference/compare/speedup.h"
#include "reference/results/references.h"
#include "reference/run/contacts_json.h"

namespace contactcheck {
namespace {

// Contacts are the same question only where they are of one kind: depth of vertices, of triangles
// or of boxes.
bool same_contacts(const Semantics& semantics, const Semantics& other) {
  const auto of_triangles = [](const Semantics& s) {
    return std::find(s.levels.begin(), s.levels.end(), Level::kTriangle) != s.levels.end();
  };
  return semantics.depth == other.depth && of_triangles(semantics) == of_triangles(other);
}

// The detectors of all processes, the judging one's first.
class Rows {
 public:
  explicit Rows(const SceneAnswers& scene) : scene_(scene) {
    for (const SceneAnswer& answer : scene.answers)
      for (const DetectorAnswer& detector : answer.detectors)
        if (!scene.broken.contains(detector.position)) add(detector, &answer == &first());
  }

  // One per detector of the task.
  std::vector<results::Run> finish(const SampleListener& tell) {
    for (auto& [position, run] : runs_)
      if (samples_.contains(position)) add_times(position, run);
    for (const auto& [position, questions] : samples_)
      for (const ProcessSamples& question : questions)
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
  void add(const DetectorAnswer& detector, bool judged) {
    const std::uint32_t position = detector.position;
    if (judged) {
      results::Run& run = runs_[position] = detector.run;
      if (scene_.recorded) run.recording = "recordings/" + task().id + ".ccr";
    } else if (runs_.at(position).ok() && !detector.run.ok()) {
      // It worked in the first process and does not in this one: that is its result.
      const std::size_t contact_frames = runs_[position].contact_frames;
      runs_[position] = detector.run;
      runs_[position].contact_frames = contact_frames;
    }
    if (detector.samples.empty() || !runs_[position].ok()) {
      samples_.erase(position);
      return;
    }
    std::vector<ProcessSamples>& by_question = samples_[position];
    by_question.resize(detector.samples.size());
    for (std::size_t q = 0; q < detector.samples.size(); ++q)
      by_question[q].push_back(detector.samples[q]);
  }

  void add_times(std::uint32_t position, results::Run& run) const {
    const std::vector<bool>& contact = first().contact_frames;
    const std::vector<ProcessSamples>& own = samples_.at(position);
    run.per_frame.frame_ms = cold_frame_ms(own.front(), run.frames);
    for (const ProcessSamples& question : own) {
      run.times.push_back(summarize_times(question, contact));
      for (const auto& [other, theirs] : samples_)
        if (is_reference(task().detectors[other])) add_speedup(other, theirs, question, run);
    }
  }

  void add_speedup(std::uint32_t other, const std::vector<ProcessSamples>& theirs,
                   const ProcessSamples& own, results::Run& run) const {
    const Question question = own.front().question;
    const results::Run& reference = runs_.at(other);
    if (question == Question::kContacts && !same_contacts(run.semantics, reference.semantics))
      return;
    for (const ProcessSamples& samples : theirs) {
      if (samples.front().question != question) continue;
      std::optional<results::Speedup> speedup =
          compute_speedup(samples, own, first().contact_frames);
      if (!speedup) continue;
      speedup->reference_options = reference.options;
      run.speedup[question][task().detectors[other]] = std::move(*speedup);
    }
  }

  bool is_reference(const std::string& name) const {
    return std::find(std::begin(kReferences), std::end(kReferences), name) !=
               std::end(kReferences) ||
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
    run.frames = first().scene.frames;
    run.contact_frames = first().scene.contact_frames;
    return run;
  }

  const SceneAnswer& first() const { return scene_.answers.front(); }
  const SceneTask& task() const { return scene_.task; }

  const SceneAnswers& scene_;
  std::map<std::uint32_t, results::Run> runs_;
  std::map<std::uint32_t, std::vector<ProcessSamples>> samples_;
};

}  // namespace

std::string place_of(const std::string& scene, const WorkerOutcome& outcome) {
  return place_text(scene, outcome.frame, outcome.phase) + ": " + outcome.reason;
}

FinishedScene put_together(const SceneAnswers& scene, const SampleListener& tell) {
  const SceneAnswer& first = scene.answers.front();
  const std::vector<std::string>& names = scene.task.detectors;
  FinishedScene finished;
  finished.scene = first.scene;
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
  finished.scene.contacts = contacts_path(scene.task.id);
  finished.contacts = contacts_text(scene.task.id, first.truth_contacts, contacts);
  return finished;
}

}  // namespace contactcheck
