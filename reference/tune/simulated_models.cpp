#include "reference/tune/simulated_models.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/dynamics/equivalent_material.h"
#include "core/types/check.h"
#include "reference/results/statistics.h"
#include "reference/scene/copies_spec.h"
#include "reference/scene/driven_simulation.h"
#include "reference/scene/simulate_scene.h"
#include "reference/scene/simulation_spec.h"
#include "reference/timing/cache_sweep.h"
#include "reference/tune/paired_cost.h"
#include "reference/tune/scene_variant.h"

namespace contactcheck::tune {
namespace {

namespace fs = std::filesystem;

/// A scene, where its motion comes by, and what each of these steps took.
class StepTimer {
 public:
  StepTimer(const scene::Scene& scene, const DetectorCatalog& catalog,
            const StepCostSettings& settings, const scene::OnStep& on_step)
      : driver_(catalog.make(catalog.parse(scene.simulation()->driver))),
        states_(scene::states_along_motion(scene, *driver_, settings.steps, on_step)),
        driven_(scene, *driver_),
        now_ms_(settings.now_ms),
        samples_(states_.size()) {}

  void time(std::size_t state) {
    if (state >= states_.size()) return;
    driven_.simulation().restore(states_[state]);
    const double start = now_ms_();
    driven_.deform();
    // A clock that has not ticked has seen a nanosecond at most.
    samples_[state].push_back(std::max(now_ms_() - start, 1e-6));
  }
  double mean() const {
    double sum = 0.0;
    for (const std::vector<double>& repeats : samples_) sum += results::median(repeats);
    return sum / static_cast<double>(samples_.size());
  }
  // Motions of different length may share the first states alone.
  results::Ratio beside(const StepTimer& anchor) const {
    PairedRun run;
    for (std::size_t state = 0; state < std::min(samples_.size(), anchor.samples_.size()); ++state)
      run[state] = {samples_[state], anchor.samples_[state]};
    return relative_cost({run});
  }

 private:
  std::unique_ptr<Detector> driver_;
  std::vector<SimulationState> states_;
  scene::DrivenSimulation driven_;
  const std::function<double()>& now_ms_;
  std::vector<std::vector<double>> samples_;  ///< [state][repeat]
};

}  // namespace

double steady_now_ms() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double, std::milli>(Clock::now().time_since_epoch()).count();
}

std::vector<Cost> step_costs(const std::vector<scene::Scene>& scenes,
                             const DetectorCatalog& catalog, const StepCostSettings& settings,
                             const scene::OnStep& on_step) {
  std::vector<std::unique_ptr<StepTimer>> timers;
  for (const scene::Scene& scene : scenes)
    timers.push_back(std::make_unique<StepTimer>(scene, catalog, settings, on_step));
  timing::CacheSweep sweep(settings.sweep_bytes);
  for (std::size_t repeat = 0; repeat < settings.repeats; ++repeat)
    for (std::size_t state = 0; state < settings.steps; ++state)
      for (std::size_t i = 0; i < timers.size(); ++i) {
        sweep.run();
        timers[(i + repeat) % timers.size()]->time(state);
      }
  if (timers.empty()) return {};
  const double unit = timers.front()->mean();
  std::vector<Cost> costs;
  for (const auto& timer : timers) {
    const results::Ratio ratio = timer->beside(*timers.front());
    costs.push_back({unit * ratio.value, unit * ratio.low, unit * ratio.high});
  }
  return costs;
}

namespace {

using Json = nlohmann::ordered_json;

// With the keys that the scene file allows for its model.
Json json_of(const Material& material) {
  Json json = {{"model", scene::name_of(material.model)}, {"mass", material.mass}};
  switch (material.model) {
    case DeformableModel::kMassSpring:
      json["stiffness"] = material.stiffness;
      json["damping"] = material.damping;
      break;
    case DeformableModel::kFiniteElements:
      json["youngs_modulus"] = material.youngs_modulus;
      json["poisson_ratio"] = material.poisson_ratio;
      json["damping_time"] = material.damping_time;
      break;
    case DeformableModel::kShapeMatching:
      json["relaxation_time"] = material.relaxation_time;
      json["region"] = material.region;
      break;
  }
  json["restitution"] = material.restitution;
  json["friction"] = material.friction;
  return json;
}

// The body of that name in the file, or the first of its copies.
std::size_t body_named(const scene::Scene& scene, const std::string& name) {
  const auto body =
      std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& candidate) {
        return candidate.name == name || candidate.name == scene::name_of_copy(name, 0);
      });
  CONTACTCHECK_INVARIANT(body != scene.bodies.end(), "every body of the file is in its scene");
  return static_cast<std::size_t>(body - scene.bodies.begin());
}

// Every step is stable for shape matching, but one longer than its relaxation time takes a body so
// far into the ground before it is answered that it does not come out again.
std::uint32_t substeps_for(const scene::Scene& scene, double relaxation_time) {
  constexpr double kMost = 1000.0;  // that a scene file may ask for
  const SimulationSettings& settings = scene.simulation()->settings;
  const double wanted = std::ceil(settings.time_step / relaxation_time);
  return std::max(settings.substeps, static_cast<std::uint32_t>(std::min(wanted, kMost)));
}

}  // namespace

std::string deformer_of(const scene::Scene& scene) {
  std::string name;
  for (const std::optional<Material>& material : scene.simulation()->materials) {
    if (!material) continue;
    const std::string own = scene::name_of(material->model);
    if (!name.empty() && name != own) return "mixed";
    name = own;
  }
  if (name.empty())
    throw InputError("scene " + scene.id + ": none of its bodies has a material to deform it by");
  return name;
}

fs::path write_deformer_variant(const fs::path& file, DeformableModel model,
                                const fs::path& folder) {
  const scene::Scene scene = scene::load_scene(file);
  return write_scene_variant(
      file, scene::name_of(model),
      [&](Json& variant, const std::string&) {
        double shortest_time = std::numeric_limits<double>::infinity();
        for (Json& body : variant["bodies"]) {
          if (!body.contains("material")) continue;
          const std::size_t b = body_named(scene, body.at("name").get<std::string>());
          const Material material =
              equivalent_material(*scene.simulation()->materials[b], model, *scene.bodies[b].shape);
          body["material"] = json_of(material);
          shortest_time = std::min(shortest_time, material.relaxation_time);
        }
        if (model == DeformableModel::kShapeMatching)
          variant["simulation"]["substeps"] = substeps_for(scene, shortest_time);
      },
      folder);
}

std::vector<SimulatedModel> simulate_models(const SimulationRequest& request,
                                            const DetectorCatalog& catalog,
                                            const std::function<void(const std::string&)>& starts) {
  std::vector<SimulatedModel> models;
  std::vector<scene::Scene> scenes;  // of the models that did not fail
  const auto record = [&](const std::string& deformer, const fs::path& file) {
    starts(deformer);
    scene::Scene scene = scene::load_scene(file, 2 * request.frames);
    scene.simulation()->settings.threads = request.settings.threads;
    scene::record_simulation(
        catalog, [](std::size_t) {}, scene);
    SimulatedModel model;
    model.deformer = deformer;
    model.file = file;
    model.split = split_recorded(scene, request.work);
    models.push_back(std::move(model));
    scenes.push_back(std::move(scene));
  };

  const std::string own = deformer_of(scene::load_scene(request.scene_file));
  record(own, request.scene_file);
  for (const std::string& deformer : request.deformers) {
    if (deformer == own) continue;
    const fs::path file = write_deformer_variant(request.scene_file, scene::model_named(deformer),
                                                 request.work / "scenes");
    try {
      record(deformer, file);
    } catch (const InputError& e) {
      SimulatedModel& failed = models.emplace_back();
      failed.deformer = deformer;
      failed.file = file;
      failed.failure = e.what();
    }
  }
  if (request.deformers.empty()) return models;

  starts("");
  StepCostSettings settings;
  settings.repeats = request.settings.step_repeats;
  settings.sweep_bytes = timing::sweep_bytes();
  const std::vector<Cost> costs = step_costs(scenes, catalog, settings, [](std::size_t) {});
  std::size_t next = 0;
  for (SimulatedModel& model : models)
    if (model.failure.empty()) model.step = costs[next++];
  return models;
}

}  // namespace contactcheck::tune
