#include "reference/run/scene_answers.h"

#include <algorithm>

#include "reference/compare/speedup.h"
#include "reference/results/references.h"
#include "reference/run/contacts_json.h"

namespace contactcheck {
namespace {

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
      for (const QuestionSamples& question : questions)
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
    std::vector<QuestionSamples> samples = scene_.turns.samples(position, run.semantics.questions);
    if (!samples.empty()) samples_[position] = std::move(samples);
  }

  void add_times(std::uint32_t position, results::Run& run) const {
    const TimedFrames frames = {scene_.judged.contact_frames, scene_.cold_frames};
    const std::vector<QuestionSamples>& own = samples_.at(position);
    run.per_frame.frame_ms = frame_ms(own.front());
    for (const QuestionSamples& question : own) {
      run.times.push_back(summarize_times(question, frames));
      for (const auto& [other, theirs] : samples_)
        if (is_reference(task().detectors[other])) add_speedup(other, theirs, question, run);
    }
  }

  void add_speedup(std::uint32_t other, const std::vector<QuestionSamples>& theirs,
                   const QuestionSamples& own, results::Run& run) const {
    const results::Run& reference = runs_.at(other);
    if (own.question == Question::kContacts && !same_contacts(run.semantics, reference.semantics))
      return;
    for (const QuestionSamples& samples : theirs) {
      if (samples.question != own.question) continue;
      results::Speedup speedup =
          compute_speedup(samples, own, {scene_.judged.contact_frames, scene_.cold_frames});
      speedup.reference_options = reference.options;
      run.speedup[own.question][task().detectors[other]] = std::move(speedup);
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
    run.frames = scene_.judged.scene.frames;
    run.contact_frames = scene_.judged.scene.contact_frames;
    return run;
  }

  const SceneTask& task() const { return scene_.task; }

  const SceneAnswers& scene_;
  std::map<std::uint32_t, results::Run> runs_;
  std::map<std::uint32_t, std::vector<QuestionSamples>> samples_;
};

}  // namespace

void TakenTurns::add(const std::vector<TurnAnswer>& answers) {
  for (const TurnAnswer& answer : answers) turns_[answer.turn.position].push_back(answer);
}

double TakenTurns::seconds(std::uint32_t position) const {
  double nanoseconds = 0.0;
  if (const auto found = turns_.find(position); found != turns_.end())
    for (const TurnAnswer& answer : found->second)
      for (const PhaseSample& frame : answer.samples)
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

std::vector<QuestionSamples> TakenTurns::samples(std::uint32_t position,
                                                 const std::vector<Question>& questions) const {
  std::vector<QuestionSamples> out;
  const auto found = turns_.find(position);
  if (found == turns_.end()) return out;
  for (const Question question : questions) {
    QuestionSamples& samples = out.emplace_back();
    samples.question = question;
    for (const TurnAnswer& answer : found->second) {
      if (answer.turn.question != question) continue;
      samples.lazy_map = answer.lazy_map;
      (answer.turn.cold ? samples.cold : samples.playback).push_back(answer.samples);
    }
  }
  return out;
}

std::string place_of(const std::string& scene, const WorkerOutcome& outcome) {
  return place_text(scene, outcome.frame, outcome.phase) + ": " + outcome.reason;
}

FinishedScene put_together(const SceneAnswers& scene, const SampleListener& tell) {
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
  finished.scene.contacts = contacts_path(scene.task.id);
  finished.contacts = contacts_text(scene.task.id, first.truth_contacts, contacts);
  return finished;
}

}  // namespace contactcheck
