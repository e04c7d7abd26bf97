#include "reference/tune/tuning.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reference/scene/any_scene.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kFinalists = 3, kAtOnce = 24;

MeasuringRequest measuring_request(const TuningRequest& request, const SceneFrames& frames) {
  MeasuringRequest measuring;
  measuring.scene_file = frames.file;
  measuring.question = request.space.question;
  measuring.settings = request.settings;
  measuring.settings.frames = frames.frames;
  measuring.work = request.out / "tune";
  measuring.executable = request.executable;
  measuring.known_defects = request.known_defects;
  return measuring;
}

// The cheapest first, those alone that met the limits.
std::vector<std::size_t> by_cost(const std::vector<Tried>& tried, const Limits& limits) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < tried.size(); ++i)
    if (limits.met_by(tried[i].measurement)) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return tried[a].measurement.cost_ms < tried[b].measurement.cost_ms;
  });
  for (std::size_t& i : order) i = tried[i].candidate;
  return order;
}

std::optional<std::size_t> cheapest(const std::vector<Tried>& tried, const Limits& limits) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < tried.size(); ++i)
    if (limits.met_by(tried[i].measurement) &&
        (!best || tried[i].measurement.cost_ms < tried[*best].measurement.cost_ms))
      best = i;
  return best;
}

/// Tells what is known each time something was measured.
class Teller {
 public:
  Teller(const Tuning& tuning, const Limits& limits,
         const std::function<void(const TuningProgress&)>& progress)
      : tuning_(tuning), limits_(limits), progress_(progress) {}

  void starts() {
    now_.candidates = tuning_.candidates.size();
    progress_(now_);
  }
  void take(const std::vector<std::size_t>& batch, const std::vector<Measurement>& found) {
    for (std::size_t i = 0; i < batch.size(); ++i)
      if (limits_.met_by(found[i]) && (best_ms_ < 0.0 || found[i].cost_ms < best_ms_)) {
        best_ms_ = found[i].cost_ms;
        now_.best = tuning_.candidates[batch[i]].detector;
      }
    now_.measured += batch.size();
    progress_(now_);
  }
  void confirms() {
    now_.confirming = true;
    progress_(now_);
  }

 private:
  const Tuning& tuning_;
  const Limits& limits_;
  const std::function<void(const TuningProgress&)>& progress_;
  TuningProgress now_;
  double best_ms_ = -1.0;
};

SearchOutcome measure_all(std::size_t count, const Limits& limits, const Measure& measure) {
  SearchOutcome out;
  for (std::size_t first = 0; first < count; first += kAtOnce) {
    std::vector<std::size_t> batch;
    for (std::size_t i = first; i < std::min(count, first + kAtOnce); ++i) batch.push_back(i);
    const std::vector<Measurement> found = measure(batch);
    for (std::size_t i = 0; i < batch.size(); ++i) out.tried.push_back({batch[i], found[i]});
  }
  out.best = cheapest(out.tried, limits);
  return out;
}

// Beside one another, since the cheapest differ by little; the next ones where none of them holds.
void confirm(const TuningRequest& request, const FrameSplit& split, const std::string& anchor,
             Tuning& tuning) {
  MeasuringRequest held_out = measuring_request(request, split.held_out);
  held_out.anchor = anchor;
  Measuring measuring(tuning.candidates, std::move(held_out));
  const std::vector<std::size_t> order = by_cost(tuning.outcome.tried, request.limits);
  for (std::size_t first = 0; first < order.size() && !tuning.chosen; first += kFinalists) {
    const std::vector<std::size_t> batch(
        order.begin() + static_cast<std::ptrdiff_t>(first),
        order.begin() + static_cast<std::ptrdiff_t>(std::min(order.size(), first + kFinalists)));
    const std::vector<Measurement> found = measuring(batch);
    for (std::size_t i = 0; i < batch.size(); ++i) tuning.confirmed.push_back({batch[i], found[i]});
    tuning.chosen = cheapest(tuning.confirmed, request.limits);
  }
  if (!tuning.chosen) return;
  const Candidate& chosen = tuning.candidates[tuning.confirmed[*tuning.chosen].candidate];
  tuning.chosen_scene =
      chosen.lattice == 1.0 ? request.target : measuring.scene_of(chosen).string();
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

Json to_json(const Tried& tried, const std::vector<Candidate>& candidates) {
  const Candidate& candidate = candidates[tried.candidate];
  Json json = {{"detector", candidate.detector}, {"lattice", candidate.lattice}};
  const Measurement& m = tried.measurement;
  if (!m.failure.empty()) {
    json["failure"] = m.failure;
    return json;
  }
  json["cost_ms"] = m.cost_ms;
  json["missed"] = m.missed;
  json["spurious"] = m.spurious;
  json["hover_gap_max"] = or_null(m.hover);
  json["late_frames"] = or_null(m.late_frames);
  json["deviation_max"] = m.deviation;
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

bool Tuning::within_budget(const std::optional<double>& budget_ms) const {
  return chosen && (!budget_ms || confirmed[*chosen].measurement.cost_ms <= *budget_ms);
}

Tuning tune(const TuningRequest& request, const DetectorCatalog& catalog,
            const std::function<void(const TuningProgress&)>& progress) {
  Tuning tuning;
  tuning.candidates = make_space(catalog, request.space);
  fs::create_directories(request.out / "tune");
  const FrameSplit split = split_frames(request.scene_file, request.frames, request.out / "tune");
  const auto frames_of = [](const SceneFrames& part) {
    return load_any_scene(part.file, part.frames);
  };
  tuning.scene = frames_of(split.chosen_by).id;
  tuning.frames = frames_of(split.chosen_by).frames;
  tuning.held_out_frames = frames_of(split.held_out).frames;
  Teller teller(tuning, request.limits, progress);
  teller.starts();
  Measuring measuring(tuning.candidates, measuring_request(request, split.chosen_by));
  const Measure measure = [&](const std::vector<std::size_t>& batch) {
    std::vector<Measurement> found = measuring(batch);
    teller.take(batch, found);
    return found;
  };
  tuning.outcome = request.exhaustive
                       ? measure_all(tuning.candidates.size(), request.limits, measure)
                       : search(tuning.candidates, request.limits, request.search, measure);
  tuning.front = pareto_front(tuning.outcome.tried);
  teller.confirms();
  confirm(request, split, measuring.anchor(), tuning);
  return tuning;
}

Json to_json(const Tuning& tuning, const TuningRequest& request) {
  Json json = {{"schema", "contactcheck-tune/1"},
               {"command", request.command},
               {"scene", tuning.scene},
               {"question", name_of(request.space.question)},
               {"limits", limits_json(request)},
               {"candidates", tuning.candidates.size()},
               {"frames", tuning.frames},
               {"held_out_frames", tuning.held_out_frames},
               {"exhausted", tuning.outcome.exhausted}};
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
  if (tuning.chosen) json["chosen"]["scene"] = tuning.chosen_scene;
  json["within_budget"] = tuning.within_budget(request.budget_ms);
  return json;
}

}  // namespace contactcheck
