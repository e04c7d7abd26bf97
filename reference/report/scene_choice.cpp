#include "reference/report/scene_choice.h"

#include <fmt/format.h>

namespace contactcheck::report {

std::vector<SceneChoice> scene_choices(const results::Results& results) {
  std::vector<SceneChoice> choices;
  SceneChoice all, hard;
  for (const results::Scene& scene : results.scenes) {
    (scene.family ? hard : all).ids.push_back(scene.id);
    if (!scene.family) choices.push_back({"scene " + scene.id, {scene.id}});
  }
  all.words = fmt::format("all {} scenes", all.ids.size());
  hard.words = hard.ids.size() == 1 ? "the family of hard cases"
                                    : fmt::format("all {} families of hard cases", hard.ids.size());
  if (!hard.ids.empty()) choices.insert(choices.begin(), hard);
  if (all.ids.size() > 1) choices.insert(choices.begin(), all);
  return choices;
}

std::vector<const results::Run*> ok_runs(const results::Index& index, const std::string& detector,
                                         const SceneChoice& scenes) {
  std::vector<const results::Run*> runs;
  for (const std::string& scene : scenes.ids)
    if (const results::Run* run = index.ok_run(scene, detector)) runs.push_back(run);
  return runs;
}

}  // namespace contactcheck::report
