// The selections that a chart can be drawn for: all scenes, all families of hard cases, each scene.
// And the scenes that a report shows one by one.
#pragma once

#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::report {

/// A selection of scenes for a chart.
struct SceneChoice {
  std::string words;  ///< "all 8 scenes"
  std::vector<std::string> ids;
};

/// From this many drawn scenes on, a report shows only sums over them.
inline constexpr std::size_t kFewestSummedScenes = 10;

/// The scenes with separate rows in a report, in the order of the file: all except many drawn
/// scenes.
std::vector<const results::Scene*> shown_scenes(const results::Results& results);

/// All scenes, all families of hard cases, drawn scenes with and without contact if there are many,
/// each single scene; without empty selections. All charts of a report have the same.
std::vector<SceneChoice> scene_choices(const results::Results& results);

/// The rows of a detector in these scenes that are `ok`, scene by scene.
std::vector<const results::Run*> ok_runs(const results::Index& index, const std::string& detector,
                                         const SceneChoice& scenes);

}  // namespace contactcheck::report
