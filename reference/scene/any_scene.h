// Where a scene comes from, and reading it from there.
#pragma once

#include <cstddef>
#include <filesystem>
#include <variant>

#include "reference/scene/random_pairs.h"
#include "reference/scene/scene.h"

namespace contactcheck::scene {

/// The file of a scene, a family or a recording (.ccr), the text of a scene, or random pairs.
using SceneSource = std::variant<std::filesystem::path, SceneText, PairSpec>;

/// `frames` above 0 replaces the number of frames, except that of random pairs.
/// @throws InputError, also where a recording is to have other frames than its own
Scene load_any_scene(const SceneSource& source, std::size_t frames = 0);

/// The same source, whatever the working directory is.
SceneSource absolute(SceneSource source);

}  // namespace contactcheck::scene
