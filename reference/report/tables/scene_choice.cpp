#include "reference/report/tables/scene_choice.h"

#include <fmt/format.h>

#include <algorithm>

namespace contactcheck::report {

std::vector<const results::Scene*> shown_scenes(const results::Results& results) {
  const auto drawn = std::count_if(results.scenes.begin(), results.scenes.end(),
                                   [](const results::Scene& s) { return s.drawn.has_value(); });
  const bool summed = static_cast<std::size_t>(drawn) >= kFewestSummedScenes;
  std::vector<const results::Scene*> out;
  for (const results::Scene& scene : results.scenes)
    if (!(summed && scene.drawn)) out.push_back(&scene);
  return out;
}

std::vector<SceneChoice> scene_choices(const results::Results& results) {
  std::vector<SceneChoice> choices;
  SceneChoice all, hard, touching, apart;
  for (const results::Scene& scene : results.scenes) {
    (scene.family ? hard : all).ids.push_back(scene.id);
    if (scene.drawn) (scene.contact_frames > 0 ? touching : apart).ids.push_back(scene.id);
  }
  if (touching.ids.size() + apart.ids.size() >= kFewestSummedScenes) {
    touching.words = fmt::format("{} drawn scenes with contact", touching.ids.size());
    apart.words = fmt::format("{} drawn scenes without contact", apart.ids.size());
    for (const SceneChoice& drawn : {touching, apart})
      if (!drawn.ids.empty()) choices.push_back(drawn);
  }
  for (const results::Scene* scene : shown_scenes(results))
    if (!scene->family) choices.push_back({"scene " + scene->id, {scene->id}});
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
