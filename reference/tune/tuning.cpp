#include "reference/tune/tuning.h"

#include <unistd.h>

#include <algorithm>

#include "core/types/check.h"
#include "reference/scene/scene.h"
#include "reference/tune/chosen_file.h"

namespace contactcheck::tune {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFinalists = 3, kAtOnce = 24;

using Half = SceneFrames FrameSplit::*;

MeasuringRequest measuring_request(const TuningRequest& request, const Tuning& tuning,
                                   const FrameSplit& split, Half half) {
  const SceneFrames& frames = split.*half;
  MeasuringRequest measuring;
  measuring.scene_file = frames.file;
  for (std::size_t i = 1; i < tuning.models.size(); ++i)
    measuring.other_deformers[tuning.models[i].deformer] = (tuning.models[i].split.*half).file;
  measuring.question = request.space.question;
  measuring.settings = request.settings;
  measuring.settings.frames = frames.frames;
  measuring.work = request.out / "tune";
  measuring.executable = request.executable;
  measuring.known_defects = request.known_defects;
  measuring.kept = request.kept;
  return measuring;
}

/// OUT/tune, for scenes that are made and for recordings; where none is, it does not stay.
class WorkFolder {
 public:
  explicit WorkFolder(const fs::path& out) : path_(out / "tune") { fs::create_directories(path_); }
  ~WorkFolder() {
    rmdir((path_ / "scenes").c_str());  // fails, as it should, where something is inside
    rmdir(path_.c_str());
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

 private:
  fs::path path_;
};

// The cheapest first, those alone that met the limits.
std::vector<std::size_t> by_cost(const std::vector<Tried>& tried, const Limits& limits) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < tried.size(); ++i)
    if (limits.met_by(tried[i].measurement)) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return tried[a].measurement.cost().ms < tried[b].measurement.cost().ms;
  });
  for (std::size_t& i : order) i = tried[i].candidate;
  return order;
}

/// Tells what is known each time something was measured.
class Teller {
 public:
  Teller(const Tuning& tuning, const Limits& limits,
         const std::function<void(const TuningProgress&)>& progress)
      : tuning_(tuning), limits_(limits), progress_(progress) {}

  void simulates(const std::string& deformer) {
    now_.simulating = deformer;
    if (!deformer.empty()) progress_(now_);
  }
  void starts() {
    now_.simulating.clear();
    now_.candidates = tuning_.candidates.size();
    progress_(now_);
  }
  void take(const std::vector<std::size_t>& batch, const std::vector<Measurement>& found) {
    for (std::size_t i = 0; i < batch.size(); ++i) remember({batch[i], found[i]});
    const auto best = cheapest(known_, limits_);
    now_.best = best ? tuning_.candidates[known_[*best].candidate].detector : "";
    now_.measured = known_.size();
    progress_(now_);
  }
  void confirms() {
    now_.confirming = true;
    progress_(now_);
  }

 private:
  // What is measured again counts once, for what is known of it last.
  void remember(const Tried& tried) {
    const auto at = std::find_if(known_.begin(), known_.end(),
                                 [&](const Tried& t) { return t.candidate == tried.candidate; });
    if (at == known_.end())
      known_.push_back(tried);
    else
      *at = tried;
  }

  const Tuning& tuning_;
  const Limits& limits_;
  const std::function<void(const TuningProgress&)>& progress_;
  TuningProgress now_;
  std::vector<Tried> known_;
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
  out.measurements = count;
  return out;
}

std::vector<std::size_t> as_cheap_as_chosen(const Tuning& tuning, const Limits& limits) {
  std::vector<std::size_t> found;
  for (const std::size_t i : as_cheap_as(*tuning.chosen, tuning.confirmed, limits))
    found.push_back(tuning.confirmed[i].candidate);
  const auto measured_as = [](const std::vector<Tried>& tried, std::size_t candidate) {
    return std::find_if(tried.begin(), tried.end(),
                        [&](const Tried& t) { return t.candidate == candidate; });
  };
  const std::vector<Tried>& tried = tuning.outcome.tried;
  const auto chosen = measured_as(tried, tuning.confirmed[*tuning.chosen].candidate);
  for (const std::size_t i :
       as_cheap_as(static_cast<std::size_t>(chosen - tried.begin()), tried, limits))
    if (measured_as(tuning.confirmed, tried[i].candidate) == tuning.confirmed.end())
      found.push_back(tried[i].candidate);
  return found;
}

// The cheapest are measured in one run, since they differ by little; if none meets the limits
// there, the next ones are.
void confirm(const TuningRequest& request, const FrameSplit& split, Tuning& tuning) {
  MeasuringRequest held_out = measuring_request(request, tuning, split, &FrameSplit::held_out);
  held_out.anchor = tuning.anchor;
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
  tuning.as_cheap = as_cheap_as_chosen(tuning, request.limits);
  const TuneCandidate& chosen = tuning.candidates[tuning.confirmed[*tuning.chosen].candidate];
  tuning.chosen_scene = request.target;
  if (chosen.lattice != 1.0) tuning.chosen_scene = measuring.scene_of(chosen).string();
  for (std::size_t i = 1; i < tuning.models.size(); ++i)
    if (tuning.models[i].deformer == chosen.deformer)
      tuning.chosen_scene = tuning.models[i].file.string();
}

FrameSplit split_of(const TuningRequest& request, const scene::Scene& scene,
                    const DetectorCatalog& catalog, Teller& teller, Tuning& tuning) {
  if (scene.simulation()) {
    if (request.space.lattices.size() > 1)
      throw InputError("--lattice: scene \"" + request.target +
                       "\" is simulated: in other lattices its materials would be others");
    SimulationRequest simulation;
    simulation.scene_file = request.scene_file;
    simulation.deformers = request.deformers;
    simulation.frames = request.frames;
    simulation.work = request.out / "tune";
    simulation.settings = request.settings;
    tuning.models = simulate_models(
        simulation, catalog, [&](const std::string& deformer) { teller.simulates(deformer); });
    return tuning.models.front().split;
  }
  if (!request.deformers.empty())
    throw InputError("--deformer: scene \"" + request.target + "\" is not simulated");
  return split_frames(request.scene_file, request.frames, request.out / "tune");
}

std::size_t count_frames(const SceneFrames& part) {
  return scene::load_any_scene(part.file, part.frames).frames;
}

}  // namespace

bool Tuning::within_budget(const std::optional<double>& budget_ms) const {
  return chosen && (!budget_ms || confirmed[*chosen].measurement.cost().ms <= *budget_ms);
}

Tuning tune(const TuningRequest& request, const DetectorCatalog& catalog,
            const std::function<void(const TuningProgress&)>& progress) {
  Tuning tuning;
  // Before a simulation that would be for nothing: are the words about detectors right?
  tuning.candidates = make_space(catalog, request.space);
  remove_old_choice(request);
  const WorkFolder work(request.out);
  Teller teller(tuning, request.limits, progress);
  const FrameSplit split =
      split_of(request, scene::load_any_scene(request.scene_file), catalog, teller, tuning);
  SpaceRequest space = request.space;
  if (!request.deformers.empty())
    for (const SimulatedModel& model : tuning.models)
      if (model.failure.empty()) space.deformers.push_back({model.deformer, model.step});
  tuning.candidates = make_space(catalog, space);
  tuning.scene = scene::load_any_scene(split.chosen_by.file).id;
  tuning.frames = count_frames(split.chosen_by);
  tuning.held_out_frames = count_frames(split.held_out);
  teller.starts();
  Measuring measuring(tuning.candidates,
                      measuring_request(request, tuning, split, &FrameSplit::chosen_by));
  const Measure measure = [&](const std::vector<std::size_t>& batch) {
    std::vector<Measurement> found = measuring(batch);
    teller.take(batch, found);
    return found;
  };
  tuning.outcome = request.exhaustive
                       ? measure_all(tuning.candidates.size(), request.limits, measure)
                       : search(tuning.candidates, request.limits, request.search, measure);
  tuning.front = pareto_front(tuning.outcome.tried);
  tuning.anchor = measuring.anchor();
  teller.confirms();
  confirm(request, split, tuning);
  return tuning;
}

}  // namespace contactcheck::tune
