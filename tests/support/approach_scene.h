// A scripted scene of two bodies, built in code: the first rests, the second comes along x and may
// leave again.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reference/scene/scene.h"

namespace contactcheck::test {

/// Keys of the x position of the second body's rest centre: seconds, metres.
using PathKeys = std::vector<Curve::Key>;

/// `moving` follows `x`, shifted by (y, z) across; both centred on the origin at rest. Levels: what
/// is to be judged.
inline scene::Scene approach_scene(std::shared_ptr<const BodyShape> resting,
                                   std::shared_ptr<const BodyShape> moving, PathKeys x, double y,
                                   double z, std::size_t frames, double time_step,
                                   std::vector<Level> levels) {
  scene::Scene scene;
  scene.id = "approach";
  scene.title = "Two bodies meet";
  scene.bodies = {{"resting", std::move(resting)}, {"moving", std::move(moving)}};
  scene.origins = {{"resting", "code", ""}, {"moving", "code", ""}};
  Motion motion;
  motion.path.position[0].keys = std::move(x);
  motion.path.position[1].keys = {{0.0, y}};
  motion.path.position[2].keys = {{0.0, z}};
  scene.motions = {Motion{}, motion};
  scene.frames = frames;
  scene.time_step = time_step;
  scene.levels = std::move(levels);
  return scene;
}

/// The nodes of all frames of a scripted scene, as a recording holds them.
inline std::vector<std::vector<std::vector<Vec3>>> recorded_frames(const scene::Scene& scene) {
  std::vector<std::vector<std::vector<Vec3>>> frames;
  for (std::size_t f = 0; f < scene.frames; ++f) frames.push_back(scene.nodes_of_frame(f));
  return frames;
}

}  // namespace contactcheck::test
