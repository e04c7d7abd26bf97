// Whatever can be named as a scene.
#pragma once

#include <cstddef>
#include <filesystem>

#include "reference/scene/scene.h"

namespace contactcheck::scene {

/// A scene, a family or a recording (.ccr). `frames` above 0 replaces the number of frames.
/// @throws InputError, also where a recording is to have other frames than its own
Scene load_any_scene(const std::filesystem::path& file, std::size_t frames = 0);

}  // namespace contactcheck::scene
