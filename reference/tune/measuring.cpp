#include "reference/tune/measuring.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "core/types/check.h"
#include "reference/compare/run_result.h"
#include "reference/run/out_folder.h"
#include "reference/scene/any_scene.h"
#include "reference/tune/lattice_variant.h"
#include "reference/tune/space.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

const Json* row_of(const Json& runs, const std::string& scene, const std::string& detector) {
  for (const Json& run : runs)
    if (run.at("scene") == scene && run.at("detector") == detector) return &run;
  return nullptr;
}

// The cold time per frame within a question; none where it was not timed.
std::optional<double> time_of(const Json& run, const std::string& question) {
  const auto in = [&](const Json& times) -> std::optional<double> {
    if (!times.is_object() || times.value("question", "") != question) return std::nullopt;
    return times.at("cold").at("frame").get<double>();
  };
  if (run.contains("time_ms"))
    if (const auto own = in(run.at("time_ms"))) return own;
  for (const Json& other : run.value("time_ms_other_questions", Json::array()))
    if (const auto time = in(other)) return time;
  return std::nullopt;
}

// How many times as fast as the anchor.
std::optional<Ratio> ratio_to(const Json& run, const std::string& question,
                              const std::string& anchor) {
  if (run.at("detector") == anchor) return Ratio{1.0, 1.0, 1.0};
  const Json speedups = run.value("speedup", Json::object()).value(question, Json::object());
  if (!speedups.contains(anchor)) return std::nullopt;
  const Json& cold = speedups.at(anchor).at("cold");
  return Ratio{cold.at("ratio").get<double>(), cold.at("low").get<double>(),
               cold.at("high").get<double>()};
}

// Errors; the cost is still missing.
Measurement errors_of(const Json& run, const std::string& level) {
  Measurement m;
  if (run.at("status") != "ok") {
    m.failure = run.at("status").get<std::string>() + ": " + run.value("message", "");
    return m;
  }
  if (!run.at("levels").contains(level)) {
    m.failure = "not judged at level " + level;
    return m;
  }
  const Json& counts = run.at("levels").at(level);
  m.missed = counts.at("missed").get<std::uint64_t>();
  m.spurious = counts.at("spurious").get<std::uint64_t>();
  const Json& geometry = run.at("geometry");
  if (!geometry.at("hover_gap_max").is_null()) m.hover = geometry.at("hover_gap_max").get<double>();
  if (!geometry.at("late_frames").is_null()) m.late_frames = geometry.at("late_frames").get<long>();
  return m;
}

}  // namespace

Measuring::Measuring(const std::vector<Candidate>& candidates, MeasuringRequest request)
    : candidates_(candidates), request_(std::move(request)), anchor_(request_.anchor) {
  const std::string id = load_any_scene(request_.scene_file, request_.settings.frames).id;
  models_[{}] = {request_.scene_file, id, 0.0};
  for (const Candidate& candidate : candidates_)
    if (const ModelKey key = key_of(candidate); !models_.contains(key))
      models_[key] = make_model(key);
}

Measuring::ModelKey Measuring::key_of(const Candidate& candidate) const {
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

std::filesystem::path Measuring::scene_of(const Candidate& candidate) const {
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
  // As long as none has answered, any of them may become what costs are taken against.
  task.references = anchor_ms_ > 0.0 ? std::vector<std::string>{anchor_} : task.detectors;
  task.frames = load_any_scene(task.file, request_.settings.frames).frames;
  return task;
}

std::vector<Measurement> Measuring::operator()(const std::vector<std::size_t>& batch) {
  SuiteRequest suite;
  std::set<ModelKey> models = {ModelKey{}};
  for (const std::size_t i : batch) models.insert(key_of(candidates_[i]));
  for (const ModelKey& key : models) {
    SceneTask task = task_of(key, batch);
    if (!task.detectors.empty()) suite.tasks.push_back(std::move(task));
  }
  const ScratchFolder scratch(request_.work);
  suite.settings = request_.settings;
  suite.out = scratch.path();
  suite.executable = request_.executable;
  suite.known_defects = request_.known_defects;
  SuiteOutcome outcome;
  const Json results = run_suite(suite, request_.listener, &outcome);
  const Json& runs = results.at("runs");
  if (!(anchor_ms_ > 0.0)) choose_anchor(runs, batch);
  std::vector<Measurement> found;
  for (const std::size_t i : batch) found.push_back(read(candidates_[i], runs));
  return found;
}

void Measuring::choose_anchor(const Json& runs, const std::vector<std::size_t>& batch) {
  std::vector<std::string> names;
  if (!anchor_.empty()) names.push_back(anchor_);
  for (const std::size_t i : batch)
    if (key_of(candidates_[i]) == ModelKey{}) names.push_back(candidates_[i].detector);
  for (const std::string& name : names) {
    const Json* run = row_of(runs, own_model().id, name);
    const auto time = run == nullptr ? std::nullopt : time_of(*run, name_of(request_.question));
    if (!time || run->at("status") != "ok" || !(*time > 0.0)) continue;
    anchor_ = name;
    anchor_ms_ = *time;
    return;
  }
}

Measurement Measuring::read(const Candidate& candidate, const Json& runs) const {
  const std::string question = name_of(request_.question);
  const Model& model = models_.at(key_of(candidate));
  const Json* run = row_of(runs, model.id, candidate.detector);
  CONTACTCHECK_INVARIANT(run != nullptr, "every detector that was asked for has a row");
  Measurement m = errors_of(*run, name_of(level_of(request_.question)));
  m.deviation = model.deviation;
  if (!m.failure.empty()) return m;
  const Json* here = row_of(runs, model.id, anchor_);
  const Json* own = row_of(runs, own_model().id, anchor_);
  const std::optional<Ratio> ratio = ratio_to(*run, question, anchor_);
  const auto anchor_here = here == nullptr ? std::nullopt : time_of(*here, question);
  const auto anchor_own = own == nullptr ? std::nullopt : time_of(*own, question);
  if (!ratio || !anchor_here || !anchor_own) {
    m.failure = "not timed in the question " + question;
    return m;
  }
  const double anchor_cost = *anchor_here * (anchor_ms_ / *anchor_own);
  m.cost_ms = anchor_cost / ratio->ratio + candidate.step_ms;
  m.cost_low_ms = anchor_cost / ratio->high + candidate.step_ms;
  m.cost_high_ms = anchor_cost / ratio->low + candidate.step_ms;
  return m;
}

}  // namespace contactcheck
