// What a chart can be drawn for: all scenes, all families of hard cases, each scene. And which
// scenes a report shows one by one.
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

/// From so many drawn scenes on, a report shows sums over them and none by itself.
inline constexpr std::size_t kFewestSummedScenes = 10;

/// Scenes that have rows of their own in a report, in the order of the file: all but drawn scenes
/// where there are many.
std::vector<const results::Scene*> shown_scenes(const results::Results& results);

/// All scenes, all families of hard cases, drawn scenes with and without contact where there are
/// many, each single scene; as far as there are such. The same for every chart of a report.
std::vector<SceneChoice> scene_choices(const results::Results& results);

/// The rows of a detector in these scenes that are `ok`, scene by scene.
std::vector<const results::Run*> ok_runs(const results::Index& index, const std::string& detector,
                                         const SceneChoice& scenes);

}  // namespace contactcheck::report
