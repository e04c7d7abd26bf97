#include "reference/tune/frame_split.h"

#include <algorithm>

#include "core/deform/recording.h"
#include "core/types/check.h"
#include "reference/scene/scene.h"

namespace contactcheck::tune {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kUsualFrames = 30, kFewestFrames = 4;

SceneFrames every_other(const scene::Scene& scene, std::size_t first, const fs::path& file) {
  Recording part{scene.id, scene.bodies, 2.0 * scene.time_step, {}};
  for (std::size_t f = first; f < scene.frames; f += 2) part.frames.push_back(scene.recorded[f]);
  write_recording(file, part);
  return {file, 0};
}

void check_frames(const scene::Scene& scene, std::size_t frames) {
  if (frames < kFewestFrames)
    throw InputError("scene " + scene.id +
                     ": to choose by some frames and confirm on others, at "
                     "least 4 are needed, and it has " +
                     std::to_string(frames));
}

}  // namespace

FrameSplit split_frames(const fs::path& file, std::size_t frames, const fs::path& work) {
  const scene::Scene scene = scene::load_any_scene(file);
  if (!scene.follows_time())
    throw InputError("scene " + scene.id + ": its frames are cases, of which none can be held out");
  if (frames > 0 && !scene.scripted())
    throw InputError("--frames: scene " + scene.id +
                     " has recorded frames; tune takes every other one of them");
  if (!scene.scripted()) return split_recorded(scene, work);
  const std::size_t count = frames > 0 ? frames : std::min(scene.frames, kUsualFrames);
  check_frames(scene, count);
  return {{file, count}, {file, count - 1}};
}

FrameSplit split_recorded(const scene::Scene& scene, const fs::path& work) {
  check_frames(scene, scene.frames);
  fs::create_directories(work);
  return {every_other(scene, 0, work / (scene.id + "-chosen-by.ccr")),
          every_other(scene, 1, work / (scene.id + "-held-out.ccr"))};
}

}  // namespace contactcheck::tune
