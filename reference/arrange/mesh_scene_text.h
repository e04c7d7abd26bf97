// The text of a scene made of meshes, laid out as a person would write it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck {

/// One body of the scene to be written.
struct BodyPlan {
  struct Key {
    double time = 0.0;  ///< seconds
    Vec3 position = Vec3::Zero();
  };
  struct Deformation {
    std::string kind;    ///< "twist" or "stretch"
    std::string amount;  ///< its key of the curve: "degrees" or "amount"
    int axis = 0;
    std::vector<std::pair<double, double>> keys;  ///< time and value
  };

  std::string name, path;
  std::optional<double> size;  ///< metres
  std::vector<Key> keys;       ///< empty: it stays in the origin
  std::optional<int> turned_about;
  std::vector<Deformation> deformations;
};

struct ScenePlan {
  std::string id, title;
  std::size_t frames = 60;
  double duration = 2.0;  ///< seconds
  bool lattices = true;
  std::vector<BodyPlan> bodies;
};

std::string scene_text(const ScenePlan& plan);

}  // namespace contactcheck
