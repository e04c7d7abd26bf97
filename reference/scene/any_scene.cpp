#include "reference/scene/any_scene.h"

#include "core/types/check.h"

namespace contactcheck::scene {

Scene load_any_scene(const std::filesystem::path& file, std::size_t frames) {
  const bool recorded = file.extension() == ".ccr";
  if (recorded && frames > 0)
    throw InputError("--frames: recording \"" + file.string() +
                     "\" has its own frames and cannot be given others");
  return recorded ? load_recording(file) : load_scene(file, frames);
}

}  // namespace contactcheck::scene
