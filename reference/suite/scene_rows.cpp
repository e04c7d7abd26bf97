#include "reference/suite/scene_rows.h"

#include <algorithm>
#include <utility>

#include "reference/judge/contacts_json.h"
#include "reference/results/references.h"
#include "reference/results/rerun.h"
#include "reference/timing/speedup.h"

namespace contactcheck::suite {
namespace {

using Samples = std::vector<timing::QuestionSamples>;  // one per question

const std::vector<TurnAnswer>& turns_of(const TakenTurns& turns, std::uint32_t position) {
  static const std::vector<TurnAnswer> none;
  const auto found = turns.find(position);
  return found == turns.end() ? none : found->second;
}

template <typename Value>
bool contains(const std::vector<Value>& values, const Value& value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

std::string recording_of(const SceneAnswers& scene) {
  return scene.recorded ? "recordings/" + scene.task.id + ".ccr" : "";
}

// The result of judging, and what the turns add to it but times. Fills `samples` where the detector
// was timed without a failure.
results::Run judged_row(const SceneAnswers& scene, const DetectorAnswer& detector,
                        Samples& samples) {
  results::Run run = detector.run;
  run.recording = recording_of(scene);
  const std::vector<TurnAnswer>& turns = turns_of(scene.turns, detector.position);
  std::vector<std::string> notes;
  for (const TurnAnswer& answer : turns)
    for (const std::string& note : answer.notes)
      if (!contains(notes, note)) notes.push_back(note);
  for (const std::string& note : notes)
    if (!contains(detector.run.notes, note)) run.notes.push_back(note + results::kWhileTimed);
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
  run.recording = recording_of(scene);
  run.failed_frame = outcome.frame;
  run.message = place_of(scene.task.id, outcome) +
                (outcome.detector ? "" : " in the suite's own code, after this detector had run") +
                (outcome.timed ? results::kWhileTimed : "");
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

}  // namespace

std::string place_of(const std::string& scene, const WorkerOutcome& outcome) {
  return process::place_text(scene, outcome.frame, outcome.phase) + ": " + outcome.reason;
}

const TurnAnswer* failed_turn(const TakenTurns& turns, std::uint32_t position) {
  for (const TurnAnswer& answer : turns_of(turns, position))
    if (!answer.error.empty()) return &answer;
  return nullptr;
}

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
  const timing::TimedFrames of_frames = {judged.contact_frames, scene.cold_frames};
  const timing::TimedFrames of_steps = {
      judged.contact_steps, timing::cold_steps(scene.cold_frames, judged.contact_steps.size())};
  for (const auto& [position, own] : samples) {
    results::Run& run = runs.at(position);
    run.per_frame.frame_ms = timing::frame_ms(own.front());
    run.per_frame.frame_ms->resize(judged.contact_frames.size());  // no step begins at the last one
    for (const timing::QuestionSamples& question : own) {
      const timing::TimedFrames& frames = is_of_steps(question.question) ? of_steps : of_frames;
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
  // Contacts of detectors whose answers count: not of one that broke later, in another process.
  std::vector<std::string> contacts;
  for (const DetectorAnswer& detector : judged.detectors)
    if (finished.runs.at(detector.position).ok() && !detector.contacts.empty())
      contacts.push_back(detector.contacts);
  finished.scene.contacts = judge::contacts_path(scene.task.id);
  finished.contacts = judge::contacts_text(scene.task.id, judged.truth_contacts, contacts);
  return finished;
}

}  // namespace contactcheck::suite
