#include "reference/scene/any_scene.h"

#include "core/types/check.h"

namespace contactcheck::scene {

Scene load_any_scene(const SceneSource& source, std::size_t frames) {
  if (const auto* pairs = std::get_if<PairSpec>(&source)) return make_pairs_scene(*pairs);
  if (const auto* text = std::get_if<SceneText>(&source)) return load_scene_text(*text, frames);
  const auto& file = std::get<std::filesystem::path>(source);
  if (file.extension() != ".ccr") return load_scene(file, frames);
  if (frames > 0)
    throw InputError("--frames: recording \"" + file.string() +
                     "\" has its own frames and cannot be given others");
  return load_recording(file);
}

SceneSource absolute(SceneSource source) {
  if (auto* file = std::get_if<std::filesystem::path>(&source))
    *file = std::filesystem::absolute(*file);
  if (auto* text = std::get_if<SceneText>(&source))
    text->folder = std::filesystem::absolute(text->folder);
  return source;
}

}  // namespace contactcheck::scene
