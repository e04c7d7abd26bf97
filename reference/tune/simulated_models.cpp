#include "reference/tune/simulated_models.h"

#include <algorithm>

#include "core/types/check.h"
#include "reference/run/cache_sweep.h"
#include "reference/scene/simulation_spec.h"
#include "reference/simulate/simulate_scene.h"
#include "reference/tune/deformer_variant.h"
#include "reference/tune/step_cost.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;

class Models {
 public:
  Models(const SimulationRequest& request, const DetectorCatalog& catalog,
         const std::function<void(const std::string&)>& starts)
      : request_(request), catalog_(catalog), starts_(starts) {}

  std::vector<SimulatedModel> make() {
    const std::string own = deformer_of(load_scene(request_.scene_file));
    record(own, request_.scene_file);
    for (const std::string& deformer : request_.deformers)
      if (deformer != own) add(deformer);
    if (!request_.deformers.empty()) measure();
    return std::move(models_);
  }

 private:
  void add(const std::string& deformer) {
    const fs::path file = write_deformer_variant(request_.scene_file, model_named(deformer),
                                                 request_.work / "scenes");
    try {
      record(deformer, file);
    } catch (const InputError& e) {
      SimulatedModel failed;
      failed.deformer = deformer;
      failed.file = file;
      failed.failure = e.what();
      models_.push_back(std::move(failed));
    }
  }

  void record(const std::string& deformer, const fs::path& file) {
    starts_(deformer);
    Scene scene = load_scene(file, 2 * request_.frames);
    scene.simulation->settings.threads = request_.settings.threads;
    record_simulation(
        catalog_, [](std::size_t) {}, scene);
    SimulatedModel model;
    model.deformer = deformer;
    model.file = file;
    model.split = split_recorded(scene, request_.work);
    models_.push_back(std::move(model));
    scenes_.push_back(std::move(scene));
  }

  void measure() {
    starts_("");
    StepCostSettings settings;
    settings.repeats = request_.settings.step_repeats;
    settings.sweep_bytes = sweep_bytes();
    const std::vector<Cost> costs = step_costs(scenes_, catalog_, settings, [](std::size_t) {});
    std::size_t next = 0;
    for (SimulatedModel& model : models_)
      if (model.failure.empty()) model.step = costs[next++];
  }

  const SimulationRequest& request_;
  const DetectorCatalog& catalog_;
  const std::function<void(const std::string&)>& starts_;
  std::vector<SimulatedModel> models_;
  std::vector<Scene> scenes_;  ///< of the models that did not fail
};

}  // namespace

std::vector<SimulatedModel> simulate_models(const SimulationRequest& request,
                                            const DetectorCatalog& catalog,
                                            const std::function<void(const std::string&)>& starts) {
  return Models(request, catalog, starts).make();
}

}  // namespace contactcheck
