#include "reference/tune/measuring.h"

#include <optional>
#include <set>

#include "core/types/check.h"
#include "reference/results/results.h"
#include "reference/run/out_folder.h"
#include "reference/scene/any_scene.h"
#include "reference/tune/lattice_variant.h"
#include "reference/tune/space.h"

namespace contactcheck {
namespace {

// The time per frame of a playback within a question; none where it was not timed.
std::optional<double> time_of(const results::Run& run, Question question) {
  for (const results::QuestionTimes& times : run.times)
    if (times.question == question) return times.playback.frame;
  return std::nullopt;
}

const QuestionSamples* found_in(
    const std::map<std::pair<std::string, std::string>, QuestionSamples>& times,
    const std::string& scene, const std::string& detector) {
  const auto at = times.find({scene, detector});
  return at == times.end() ? nullptr : &at->second;
}

// What one side costs in units of the other; nothing where one of them was not timed.
PairedRun paired(const QuestionSamples* own, const QuestionSamples* anchor) {
  return own != nullptr && anchor != nullptr ? pair_up(*own, *anchor) : PairedRun{};
}

// Without truth there is nothing to choose by.
void expect_judged(const std::vector<results::Scene>& scenes) {
  for (const results::Scene& scene : scenes)
    if (!scene.unjudged.empty()) throw InputError(scene.unjudged);
}

// Errors; the cost is still missing.
Measurement errors_of(const results::Run& run, Level level) {
  Measurement m;
  if (!run.ok()) {
    m.failure = std::string(name_of(run.status)) + ": " + run.message;
    return m;
  }
  const auto counts = run.levels.find(level);
  if (counts == run.levels.end()) {
    m.failure = std::string("not judged at level ") + name_of(level);
    return m;
  }
  m.missed = counts->second.missed;
  m.spurious = counts->second.spurious;
  if (run.geometry.hover_gap_max) m.hover = *run.geometry.hover_gap_max;
  if (run.geometry.late_frames) m.late_frames = *run.geometry.late_frames;
  return m;
}

}  // namespace

Measuring::Measuring(const std::vector<TuneCandidate>& candidates, MeasuringRequest request)
    : candidates_(candidates), request_(std::move(request)), anchor_(request_.anchor) {
  const std::string id = load_any_scene(request_.scene_file, request_.settings.frames).id;
  models_[{}] = {request_.scene_file, id, 0.0};
  for (const TuneCandidate& candidate : candidates_) {
    const ModelKey key = key_of(candidate);
    if (!models_.contains(key)) models_[key] = make_model(key);
    book_.add_model(key, candidate.step);
  }
}

ModelKey Measuring::key_of(const TuneCandidate& candidate) const {
  const bool own = !request_.other_deformers.contains(candidate.deformer);
  return {candidate.lattice, own ? "" : candidate.deformer};
}

Measuring::Model Measuring::make_model(const ModelKey& key) const {
  const std::size_t frames = request_.settings.frames;
  const Scene scene = load_any_scene(request_.scene_file, frames);
  Model model;
  if (!key.deformer.empty()) {
    model.file = request_.other_deformers.at(key.deformer);
  } else {
    if (!scene.scripted())
      throw InputError("scene " + scene.id +
                       " is not scripted: its lattices cannot be of another resolution");
    model.file = write_lattice_variant(request_.scene_file, key.lattice, request_.work / "scenes");
  }
  const Scene variant = load_any_scene(model.file, frames);
  model.id = variant.id;
  model.deviation = deviation(scene, variant);
  return model;
}

std::filesystem::path Measuring::scene_of(const TuneCandidate& candidate) const {
  return models_.at(key_of(candidate)).file;
}

SceneTask Measuring::task_of(const ModelKey& key, const std::vector<std::size_t>& batch) const {
  SceneTask task;
  task.id = models_.at(key).id;
  task.file = models_.at(key).file;
  std::set<std::string> names;
  const auto add = [&](const std::string& name) {
    if (names.insert(name).second) task.detectors.push_back(name);
  };
  if (!anchor_.empty()) add(anchor_);
  for (const std::size_t i : batch)
    if (key_of(candidates_[i]) == key) add(candidates_[i].detector);
  task.frames = load_any_scene(task.file, request_.settings.frames).frames;
  return task;
}

std::vector<Measurement> Measuring::operator()(const std::vector<std::size_t>& batch) {
  std::set<ModelKey> all = {ModelKey{}};
  for (const std::size_t i : batch) all.insert(key_of(candidates_[i]));
  const std::vector<ModelKey> keys(all.begin(), all.end());
  Times times;
  const results::Results results = run(keys, batch, times);
  const results::Index rows(results);
  if (!book_.has_unit()) choose_anchor(rows, batch);
  take_times(keys, batch, times);
  std::vector<Measurement> found;
  for (const std::size_t i : batch) found.push_back(read(i, rows));
  return found;
}

results::Results Measuring::run(const std::vector<ModelKey>& keys,
                                const std::vector<std::size_t>& batch, Times& times) const {
  SuiteRequest suite;
  for (const ModelKey& key : keys) {
    SceneTask task = task_of(key, batch);
    if (!task.detectors.empty()) suite.tasks.push_back(std::move(task));
  }
  const ScratchFolder scratch(request_.work);
  suite.settings = request_.settings;
  suite.out = scratch.path();
  suite.executable = request_.executable;
  suite.known_defects = request_.known_defects;
  SuiteListener listener = request_.listener;
  listener.samples = [&](const std::string& scene, const std::string& detector,
                         const QuestionSamples& samples) {
    if (samples.question == request_.question) times[{scene, detector}] = samples;
  };
  SuiteOutcome outcome;
  results::Results results = run_suite(suite, listener, &outcome);
  expect_judged(results.scenes);
  return results;
}

void Measuring::choose_anchor(const results::Index& rows, const std::vector<std::size_t>& batch) {
  std::vector<std::string> names;
  if (!anchor_.empty()) names.push_back(anchor_);
  for (const std::size_t i : batch)
    if (key_of(candidates_[i]) == ModelKey{}) names.push_back(candidates_[i].detector);
  for (const std::string& name : names) {
    const results::Run* run = rows.run(own_model().id, name);
    const auto time = run == nullptr ? std::nullopt : time_of(*run, request_.question);
    if (!time || !(*time > 0.0)) continue;
    anchor_ = name;
    book_.set_unit(*time);
    return;
  }
}

void Measuring::take_times(const std::vector<ModelKey>& keys, const std::vector<std::size_t>& batch,
                           const Times& times) {
  for (const ModelKey& key : keys)
    book_.take_anchor(key, paired(found_in(times, models_.at(key).id, anchor_),
                                  found_in(times, own_model().id, anchor_)));
  for (const std::size_t i : batch) {
    const std::string& scene = models_.at(key_of(candidates_[i])).id;
    book_.take(i, paired(found_in(times, scene, candidates_[i].detector),
                         found_in(times, scene, anchor_)));
  }
}

Measurement Measuring::read(std::size_t index, const results::Index& rows) const {
  const TuneCandidate& candidate = candidates_[index];
  const ModelKey key = key_of(candidate);
  const results::Run* run = rows.run(models_.at(key).id, candidate.detector);
  CONTACTCHECK_INVARIANT(run != nullptr, "every detector that was asked for has a row");
  Measurement m = errors_of(*run, level_of(request_.question));
  m.deviation = models_.at(key).deviation;
  if (m.failure.empty() && !book_.price(index, key, m))
    m.failure = std::string("not timed in the question ") + name_of(request_.question);
  return m;
}

}  // namespace contactcheck
