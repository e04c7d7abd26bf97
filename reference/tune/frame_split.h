// Frames for choosing, and other frames for confirming the choice.
#pragma once

#include <cstddef>
#include <filesystem>

#include "reference/scene/scene.h"

namespace contactcheck::tune {

/// A scene as it is run: its file, and how many frames of it.
struct SceneFrames {
  std::filesystem::path file;
  std::size_t frames = 0;  ///< 0: all that a recording has
};

struct FrameSplit {
  SceneFrames chosen_by, held_out;
};

/// For a scripted scene: `frames` moments (0: at most 30) and one less, over the same time, which
/// share only the first and the last. For a recording: every other frame, written to `work`.
/// @pre the scene is not simulated
/// @throws InputError for scenes that cannot be split: families, and those with fewer than 4 frames
FrameSplit split_frames(const std::filesystem::path& file, std::size_t frames,
                        const std::filesystem::path& work);

/// For a scene with recorded frames: every other one, written to `work`.
/// @throws InputError for fewer than 4 frames
FrameSplit split_recorded(const scene::Scene& scene, const std::filesystem::path& work);

}  // namespace contactcheck::tune
