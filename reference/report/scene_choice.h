// What a chart can be drawn for: all scenes, all families of hard cases, each scene.
#pragma once

#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::report {

/// Scenes that one chart can be drawn for.
struct SceneChoice {
  std::string words;  ///< "all 8 scenes"
  std::vector<std::string> ids;
};

/// All scenes, all families of hard cases, each scene; as far as there are such. The same for every
/// chart of a report.
std::vector<SceneChoice> scene_choices(const results::Results& results);

/// The rows of a detector in these scenes that are `ok`, scene by scene.
std::vector<const results::Run*> ok_runs(const results::Index& index, const std::string& detector,
                                         const SceneChoice& scenes);

}  // namespace contactcheck::report
