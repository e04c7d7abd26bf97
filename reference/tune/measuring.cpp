#include "reference/tune/measuring.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/types/check.h"
#include "reference/results/results.h"
#include "reference/results/results_json.h"
#include "reference/results/statistics.h"
#include "reference/scene/frame_positions.h"
#include "reference/scene/scene.h"
#include "reference/suite/job.h"
#include "reference/suite/out_folder.h"
#include "reference/suite/run_identity.h"
#include "reference/text/lists.h"
#include "reference/tune/scene_variant.h"
#include "reference/tune/space.h"

namespace contactcheck::tune {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void scale_lattice(Json& body, double factor, const std::string& document) {
  if (!body.contains("lattice"))
    throw InputError(document + ": body \"" + body.value("name", "") +
                     "\" has no lattice, whose resolution could be another");
  Json& lattice = body["lattice"];
  if (lattice.contains("kept")) {
    const double kept = std::round(lattice["kept"].get<double>() * factor);
    lattice["kept"] = static_cast<std::size_t>(std::max(1.0, kept));
  } else if (lattice.contains("cells")) {
    for (Json& cells : lattice["cells"]) {
      const double along = std::round(cells.get<double>() * std::cbrt(factor));
      cells = static_cast<std::size_t>(std::max(1.0, along));
    }
  } else {
    throw InputError(document + ": the lattice of body \"" + body.value("name", "") +
                     "\" has neither \"kept\" nor \"cells\"");
  }
}

}  // namespace

fs::path write_lattice_variant(const fs::path& file, double factor, const fs::path& folder) {
  return write_scene_variant(
      file, fmt::format("lattice-{:g}", 100.0 * factor),
      [&](Json& scene, const std::string& document) {
        for (Json& body : scene["bodies"]) scale_lattice(body, factor, document);
      },
      folder);
}

double deviation(const scene::Scene& scene, const scene::Scene& variant) {
  const scene::FramePositions first(scene), second(variant);
  double largest = 0.0;
  for (std::size_t f = 0; f < scene.frames; ++f)
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const auto &one = first[f].vertices[b], &other = second[f].vertices[b];
      if (one.size() != other.size())
        throw InputError("scene " + variant.id + " has other meshes than " + scene.id);
      for (std::size_t v = 0; v < one.size(); ++v)
        largest = std::max(largest, (one[v] - other[v]).norm());
    }
  return largest;
}

void CostBook::set_unit(double anchor_ms) {
  CONTACTCHECK_INVARIANT(anchor_ms > 0.0, "a time to count in");
  unit_ms_ = anchor_ms;
  models_[{}].cost->anchor_ms = {anchor_ms, anchor_ms, anchor_ms};
}

void CostBook::add_model(const ModelKey& key, const Cost& step) { models_[key].cost->step = step; }

void CostBook::take_anchor(const ModelKey& key, const PairedRun& run) {
  if (key == ModelKey{} || run.empty()) return;
  Model& model = models_.at(key);
  model.scales.push_back(relative_cost({run}));
  const results::Ratio scale = results::median_ratio(model.scales);
  model.cost->anchor_ms = {unit_ms_ * scale.value, unit_ms_ * scale.low, unit_ms_ * scale.high};
}

void CostBook::take(std::size_t candidate, PairedRun run) {
  if (!run.empty()) paired_[candidate].push_back(std::move(run));
}

bool CostBook::price(std::size_t candidate, const ModelKey& key, Measurement& m) const {
  const Model& model = models_.at(key);
  const auto runs = paired_.find(candidate);
  if (runs == paired_.end() || (key != ModelKey{} && model.scales.empty())) return false;
  m.beside_anchor = relative_cost(runs->second);
  m.model = model.cost;
  return true;
}

namespace {

const timing::QuestionSamples* found_in(
    const std::map<std::pair<std::string, std::string>, timing::QuestionSamples>& times,
    const std::string& scene, const std::string& detector) {
  const auto at = times.find({scene, detector});
  return at == times.end() ? nullptr : &at->second;
}

// What one side costs in units of the other; nothing where one of them was not timed.
PairedRun paired(const timing::QuestionSamples* own, const timing::QuestionSamples* anchor) {
  return own != nullptr && anchor != nullptr ? pair_up(*own, *anchor) : PairedRun{};
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
  const std::string id = scene::load_any_scene(request_.scene_file, request_.settings.frames).id;
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
  const scene::Scene scene = scene::load_any_scene(request_.scene_file, frames);
  Model model;
  if (!key.deformer.empty()) {
    model.file = request_.other_deformers.at(key.deformer);
  } else {
    if (!scene.scripted())
      throw InputError("scene " + scene.id +
                       " is not scripted: its lattices cannot be of another resolution");
    model.file = write_lattice_variant(request_.scene_file, key.lattice, request_.work / "scenes");
  }
  const scene::Scene variant = scene::load_any_scene(model.file, frames);
  model.id = variant.id;
  model.deviation = deviation(scene, variant);
  return model;
}

std::filesystem::path Measuring::scene_of(const TuneCandidate& candidate) const {
  return models_.at(key_of(candidate)).file;
}

std::vector<Measurement> Measuring::operator()(const std::vector<std::size_t>& batch) {
  std::set<ModelKey> all = {ModelKey{}};
  for (const std::size_t i : batch) all.insert(key_of(candidates_[i]));
  const std::vector<ModelKey> keys(all.begin(), all.end());
  Times times;
  const results::Results results = run(keys, batch, times);
  const results::Index rows(results);
  if (!book_.has_unit()) choose_anchor(rows, batch);
  for (const ModelKey& key : keys)
    book_.take_anchor(key, paired(found_in(times, models_.at(key).id, anchor_),
                                  found_in(times, own_model().id, anchor_)));
  for (const std::size_t i : batch) {
    const std::string& scene = models_.at(key_of(candidates_[i])).id;
    book_.take(i, paired(found_in(times, scene, candidates_[i].detector),
                         found_in(times, scene, anchor_)));
  }
  std::vector<Measurement> found;
  for (const std::size_t i : batch) {
    const ModelKey key = key_of(candidates_[i]);
    const results::Run* run = rows.run(models_.at(key).id, candidates_[i].detector);
    CONTACTCHECK_INVARIANT(run != nullptr, "every detector that was asked for has a row");
    Measurement& m = found.emplace_back(errors_of(*run, level_of(request_.question)));
    m.deviation = models_.at(key).deviation;
    m.scale = rows.scene(run->scene)->scale;
    std::ranges::copy_if(results.known_ranges, std::back_inserter(m.ranges),
                         [&](const auto& range) { return range.detector == run->detector; });
    if (m.failure.empty() && !book_.price(i, key, m))
      m.failure = std::string("not timed in the question ") + name_of(request_.question);
  }
  return found;
}

results::Results Measuring::run(const std::vector<ModelKey>& keys,
                                const std::vector<std::size_t>& batch, Times& times) const {
  std::string what;
  suite::SuiteRequest suite;
  for (const ModelKey& key : keys) {
    suite::SceneTask task;
    task.id = models_.at(key).id;
    task.source = models_.at(key).file;
    std::set<std::string> names;
    const auto add = [&](const std::string& name) {
      if (names.insert(name).second) task.detectors.push_back(name);
    };
    if (!anchor_.empty()) add(anchor_);
    for (const std::size_t i : batch)
      if (key_of(candidates_[i]) == key) add(candidates_[i].detector);
    const scene::Scene scene = scene::load_any_scene(task.source, request_.settings.frames);
    task.frames = scene.frames;
    if (task.detectors.empty()) continue;
    what += task.id + " " + suite::content_of(task.source, scene) + ", " +
            std::to_string(task.frames) + " frames: " + text::joined(task.detectors) + "\n";
    suite.tasks.push_back(std::move(task));
  }
  if (request_.kept != nullptr)
    if (const auto part = request_.kept->take(what)) {
      for (const auto& entry : part->at("times"))
        times[{entry.at(0).get<std::string>(), entry.at(1).get<std::string>()}] =
            suite::samples_from_json(entry.at(2));
      return results::from_json(part->at("results"));
    }
  const suite::ScratchFolder scratch(request_.work);
  suite.settings = request_.settings;
  suite.out = scratch.path();
  suite.executable = request_.executable;
  suite.known_defects = request_.known_defects;
  suite::SuiteListener listener = request_.listener;
  listener.samples = [&](const std::string& scene, const std::string& detector,
                         const timing::QuestionSamples& samples) {
    if (samples.question == request_.question) times[{scene, detector}] = samples;
  };
  suite::SuiteOutcome outcome;
  results::Results results = suite::run_suite(suite, listener, &outcome);
  for (const results::Scene& scene : results.scenes)  // without truth nothing can be chosen by
    if (!scene.unjudged.empty()) throw InputError(scene.unjudged);
  if (request_.kept != nullptr) {
    Json measured = Json::array();
    for (const auto& [name, samples] : times)
      measured.push_back({name.first, name.second, suite::samples_json(samples)});
    request_.kept->keep(what, {{"results", results::to_json(results)}, {"times", measured}});
  }
  return results;
}

void Measuring::choose_anchor(const results::Index& rows, const std::vector<std::size_t>& batch) {
  std::vector<std::string> names;
  if (!anchor_.empty()) names.push_back(anchor_);
  for (const std::size_t i : batch)
    if (key_of(candidates_[i]) == ModelKey{}) names.push_back(candidates_[i].detector);
  for (const std::string& name : names) {
    const results::Run* run = rows.run(own_model().id, name);
    if (run == nullptr) continue;
    const auto times = std::find_if(
        run->times.begin(), run->times.end(),
        [&](const results::QuestionTimes& t) { return t.question == request_.question; });
    if (times == run->times.end() || !(times->playback.frame > 0.0)) continue;
    anchor_ = name;
    book_.set_unit(times->playback.frame);
    return;
  }
}

}  // namespace contactcheck::tune
