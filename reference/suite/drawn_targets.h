// Targets of `run` that are drawn from a seed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reference/results/results.h"
#include "reference/scene/scene.h"
#include "reference/suite/run_plan.h"
#include "reference/suite/suite_request.h"

namespace contactcheck::suite {

struct DrawnTarget {
  std::vector<scene::DrawnSpec> scenes;
  std::vector<std::string> detectors;  ///< of the rules
};

/// What `name` stands for: `drawn` and a file of rules for as many scenes as --count says, of the
/// seed of --seed; `drawn-S-I` for one of them. `drawn-steps` in place of `drawn`, or --steps, for
/// scenes that are judged between frames. Nothing where it names something else.
/// @throws InputError for bad rules or meshes, or what is no such scene
std::optional<DrawnTarget> find_drawn(const std::string& name, const RunTargets& wanted);

/// Keeps scenes as scene files where --save-scene says: one of a run of one scene in the file of
/// that name, those of others as SCENE.json in the folder. Drawn ones of the tasks `own` alone.
/// @throws InputError for what no scene file can hold, or what is there already and other
void save_scenes(const std::filesystem::path& path, const std::vector<SceneTask>& run,
                 const std::vector<SceneTask>& own);

/// Again those that a limit has made others.
void save_redrawn(const std::filesystem::path& path, const std::vector<SceneTask>& run,
                  const std::vector<SceneTask>& own, const results::Results& results);

}  // namespace contactcheck::suite
