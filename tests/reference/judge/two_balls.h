// Simulated scenes of two soft balls, built in code, and detectors that see nothing or all.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reference/scene/scene.h"
#include "tests/faults/broken_detectors.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

inline constexpr double kBallRadius = 0.25;  ///< metres

/// One ball: its centre and velocity at time 0.
struct BallStart {
  Vec3 center = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
};

/// Two balls without gravity and ground, judged 60 times a second. The driver has no name: tests
/// hand theirs over.
inline scene::Scene two_balls(const BallStart& first, const BallStart& second, std::size_t frames) {
  // Firm enough that a ball falling from its own height stays round.
  const Material material{.mass = 1.0, .stiffness = 400.0, .damping = 1.0};
  const auto shape = make_body("", sphere_mesh(Vec3::Zero(), kBallRadius, 2), {2, 2, 2}).shape;
  scene::Scene scene;
  scene.id = "two-balls";
  scene.title = "Two balls";
  scene.frames = frames;
  scene.levels = {Level::kBody, Level::kTriangle, Level::kVertex};
  scene::SimulationSpec spec;
  spec.settings.gravity = Vec3::Zero();
  for (const auto& [name, start] : {std::pair{"first", first}, std::pair{"second", second}}) {
    scene.bodies.push_back({name, shape});
    scene.origins.push_back({name, "code", ""});
    Motion motion;
    for (int axis = 0; axis < 3; ++axis)
      motion.path.position[static_cast<std::size_t>(axis)].keys = {{0.0, start.center[axis]}};
    scene.motions.push_back(motion);
    spec.materials.emplace_back(material);
    spec.velocities.push_back(start.velocity);
  }
  scene.time_step = spec.settings.time_step;
  scene.kind = std::move(spec);
  return scene;
}

/// The first lies just above the ground, the second falls on it, a little aside.
inline scene::Scene falling_balls(std::size_t frames) {
  scene::Scene scene = two_balls({{0.0, 0.27, 0.0}}, {{0.05, 0.9, 0.03}}, frames);
  scene.simulation()->settings.gravity = Vec3(0.0, -9.81, 0.0);
  scene.simulation()->settings.ground = Ground{};
  return scene;
}

/// The second comes along x, a little aside, at 4 m/s: a quarter of a radius per step, so that no
/// contact falls between two frames.
inline scene::Scene shot(std::size_t frames) {
  return two_balls({}, {{-1.0, 0.02, 0.01}, {4.0, 0.0, 0.0}}, frames);
}

/// Claims bodies and triangles, and never reports anything.
class Blind : public TruthfulDetector {
  std::vector<ElementPair> spoiled_triangles(std::vector<ElementPair>) override { return {}; }
  std::vector<BodyPair> spoiled_bodies(std::vector<BodyPair>) override { return {}; }
};

}  // namespace contactcheck::test
