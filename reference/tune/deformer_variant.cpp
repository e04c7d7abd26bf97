#include "reference/tune/deformer_variant.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/dynamics/equivalent_material.h"
#include "core/types/check.h"
#include "reference/scene/copies_spec.h"
#include "reference/scene/simulation_spec.h"
#include "reference/tune/scene_variant.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// With the keys that the scene file allows for its model.
Json json_of(const Material& material) {
  Json json = {{"model", name_of(material.model)}, {"mass", material.mass}};
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
std::size_t body_named(const Scene& scene, const std::string& name) {
  const auto body =
      std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& candidate) {
        return candidate.name == name || candidate.name == name_of_copy(name, 0);
      });
  CONTACTCHECK_INVARIANT(body != scene.bodies.end(), "every body of the file is in its scene");
  return static_cast<std::size_t>(body - scene.bodies.begin());
}

// Every step is stable for shape matching, but one longer than its relaxation time takes a body so
// far into the ground before it is answered that it does not come out again.
std::uint32_t substeps_for(const Scene& scene, double relaxation_time) {
  constexpr double kMost = 1000.0;  // that a scene file may ask for
  const SimulationSettings& settings = scene.simulation->settings;
  const double wanted = std::ceil(settings.time_step / relaxation_time);
  return std::max(settings.substeps, static_cast<std::uint32_t>(std::min(wanted, kMost)));
}

}  // namespace

std::string deformer_of(const Scene& scene) {
  std::string name;
  for (const std::optional<Material>& material : scene.simulation->materials) {
    if (!material) continue;
    const std::string own = name_of(material->model);
    if (!name.empty() && name != own) return "mixed";
    name = own;
  }
  if (name.empty())
    throw InputError("scene " + scene.id + ": none of its bodies has a material to deform it by");
  return name;
}

fs::path write_deformer_variant(const fs::path& file, DeformableModel model,
                                const fs::path& folder) {
  const Scene scene = load_scene(file);
  return write_scene_variant(
      file, name_of(model),
      [&](Json& variant, const std::string&) {
        double shortest_time = std::numeric_limits<double>::infinity();
        for (Json& body : variant["bodies"]) {
          if (!body.contains("material")) continue;
          const std::size_t b = body_named(scene, body.at("name").get<std::string>());
          const Material material =
              equivalent_material(*scene.simulation->materials[b], model, *scene.bodies[b].shape);
          body["material"] = json_of(material);
          shortest_time = std::min(shortest_time, material.relaxation_time);
        }
        if (model == DeformableModel::kShapeMatching)
          variant["simulation"]["substeps"] = substeps_for(scene, shortest_time);
      },
      folder);
}

}  // namespace contactcheck
