// What a run is asked for, as scenes with their detectors.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "reference/results/results.h"
#include "reference/scene/mesh_scene.h"
#include "reference/scene/scene.h"
#include "reference/suite/suite_request.h"

namespace contactcheck::suite {

/// As the options of `run` have it.
struct RunTargets {
  std::vector<std::string> targets;    ///< suites, scenes, files; empty: the suite default
  std::vector<std::string> detectors;  ///< names or libraries; empty: those of the suite
  std::size_t frames = 0;              ///< of each scene; 0: its own
  std::uint64_t seed = RunSettings{}.seed;
  std::optional<std::size_t> count;      ///< of scenes of the suite drawn
  bool steps = false;                    ///< scenes of the suite drawn are judged between frames
  std::optional<scene::PairSpec> pairs;  ///< adds a scene of random pairs to the targets
  /// A scene of these beside the targets, or what drawn ones among them are made of; no mesh: none.
  scene::MeshSceneRequest meshes;
  std::filesystem::path save_scene;  ///< where scenes are kept as files; empty: nowhere
  std::uint32_t threads = 1;         ///< of each detector that has such an option
  std::vector<std::string> isas;     ///< instruction sets; empty: the best
};

struct RunPlan {
  std::vector<SceneTask> scenes;     ///< with their ids, frames and contents
  std::vector<results::Goal> goals;  ///< of all suites, canonical
};

/// Names of detectors become canonical, with threads and instruction sets as options of those that
/// have them. Every scene but those that are drawn is read: a bad one ends the run before it has
/// written a byte.
/// @throws InputError for unknown names, bad scenes, two scenes of one id
RunPlan plan_run(const RunTargets& wanted, const DetectorCatalog& catalog);

/// Every detector of a suite, those of its scenes included, each once.
/// @throws InputError where there is no such suite
std::vector<std::string> detectors_of(const std::string& name);

}  // namespace contactcheck::suite
