#include <cmath>
#include <nlohmann/json.hpp>

#include "reference/results/results_json.h"
#include "reference/tune/chosen_file.h"
#include "reference/tune/tuning.h"

namespace contactcheck::tune {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

Json to_json(const TuneCandidate& candidate) {
  Json json = {{"detector", candidate.detector}, {"lattice", candidate.lattice}};
  if (!candidate.deformer.empty()) json["deformer"] = candidate.deformer;
  return json;
}

Json to_json(const Tried& tried, const std::vector<TuneCandidate>& candidates) {
  const TuneCandidate& candidate = candidates[tried.candidate];
  Json json = to_json(candidate);
  const Measurement& m = tried.measurement;
  if (!m.failure.empty()) {
    json["failure"] = m.failure;
    return json;
  }
  const Cost cost = m.cost();
  json["cost_ms"] = cost.ms;
  const bool known = std::isfinite(cost.high_ms);
  json["cost_ms_low"] = known ? Json(cost.low_ms) : Json();
  json["cost_ms_high"] = known ? Json(cost.high_ms) : Json();
  json["times"] = tried.times;
  if (!candidate.deformer.empty()) json["step_ms"] = candidate.step.ms;
  json["missed"] = m.missed;
  json["spurious"] = m.spurious;
  json["hover_gap_max"] = or_null(m.hover);
  json["late_frames"] = or_null(m.late_frames);
  json["deviation_max"] = m.deviation;
  for (const results::ScaleRange& range : m.ranges)
    json["known_ranges"].push_back(results::to_json(range));
  return json;
}

Json to_json(const SimulatedModel& model) {
  Json json = {{"deformer", model.deformer}, {"scene", model.file.string()}};
  if (!model.failure.empty()) {
    json["failure"] = model.failure;
  } else {
    json["step_ms"] = model.step.ms;
    json["step_ms_low"] = model.step.low_ms;
    json["step_ms_high"] = model.step.high_ms;
  }
  return json;
}

Json limits_json(const TuningRequest& request) {
  const Limits& limits = request.limits;
  return {
      {"missed", or_null(limits.missed)},           {"spurious", or_null(limits.spurious)},
      {"hover_gap_max", or_null(limits.hover)},     {"late_frames", or_null(limits.late_frames)},
      {"deviation_max", or_null(limits.deviation)}, {"budget_ms", or_null(request.budget_ms)}};
}

}  // namespace

Json to_json(const Tuning& tuning, const TuningRequest& request) {
  Json json = {{"schema", "contactcheck-tune/1"},
               {"command", request.command},
               {"scene", tuning.scene},
               {"question", name_of(request.space.question)},
               {"limits", limits_json(request)},
               {"candidates", tuning.candidates.size()},
               {"frames", tuning.frames},
               {"held_out_frames", tuning.held_out_frames},
               {"measurements", tuning.outcome.measurements},
               {"exhausted", tuning.outcome.exhausted},
               {"anchor", tuning.anchor}};
  if (tuning.varies_deformers()) {
    json["deformers"] = Json::array();
    for (const SimulatedModel& model : tuning.models) json["deformers"].push_back(to_json(model));
  }
  json["measured"] = Json::array();
  for (const Tried& tried : tuning.outcome.tried)
    json["measured"].push_back(to_json(tried, tuning.candidates));
  json["front"] = Json::array();
  for (const std::size_t i : tuning.front)
    json["front"].push_back(to_json(tuning.outcome.tried[i], tuning.candidates));
  json["confirmed"] = Json::array();
  for (const Tried& tried : tuning.confirmed)
    json["confirmed"].push_back(to_json(tried, tuning.candidates));
  json["chosen"] =
      tuning.chosen ? to_json(tuning.confirmed[*tuning.chosen], tuning.candidates) : Json();
  if (tuning.chosen) {
    json["chosen"]["scene"] = tuning.chosen_scene;
    json["chosen"]["file"] = chosen_file(request).filename().string();
  }
  json["as_cheap"] = Json::array();
  for (const std::size_t i : tuning.as_cheap)
    json["as_cheap"].push_back(to_json(tuning.candidates[i]));
  json["within_budget"] = tuning.within_budget(request.budget_ms);
  return json;
}

}  // namespace contactcheck::tune
