// Balls that meet, as scenes, and detectors made up for the tests of the driven simulation.
#pragma once

#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/detect/registry.h"
#include "core/types/check.h"
#include "reference/scene/scene.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

/// Metres.
inline constexpr double kBallRadius = 0.1;

inline RigidPath at(const Vec3& place) {
  RigidPath path;
  for (int k = 0; k < 3; ++k) path.position[k] = {{{0.0, place[k]}}, false};
  return path;
}

inline void add_body(scene::Scene& scene, const Body& body, const Vec3& place, const Vec3& velocity,
                     const std::optional<Material>& material) {
  scene.bodies.push_back(body);
  scene.origins.push_back({body.name, "test", ""});
  scene.motions.push_back({{}, at(place)});
  scene.simulation()->materials.push_back(material);
  scene.simulation()->velocities.push_back(velocity);
}

/// Of 1 kg, so soft that few substeps do.
inline Material ball_material() {
  Material material;
  material.stiffness = 400.0;
  material.damping = 1.0;
  return material;
}

inline Body ball(const std::string& name) {
  return make_body(name, sphere_mesh(Vec3::Zero(), kBallRadius, 2), {3, 3, 3});
}

inline scene::Scene empty_scene(std::size_t frames) {
  scene::Scene scene;
  scene.id = "test-balls";
  scene.frames = frames;
  scene.kind = scene::SimulationSpec{};
  scene.simulation()->driver = "ffd-aabb-sphere2+tri";
  scene.time_step = scene.simulation()->settings.time_step;
  return scene;
}

/// Two balls fall; the upper one is 1 m/s faster and would be through the lower one, 0.25 m below
/// it, after 30 steps of 1/60 s. Faster ones get so deep within one step that the response to cells
/// pushes them sideways.
inline scene::Scene falling_balls(std::size_t frames = 30) {
  scene::Scene scene = empty_scene(frames);
  add_body(scene, ball("upper"), {0.02, 0.25, 0.01}, {0, -1, 0}, ball_material());
  add_body(scene, ball("lower"), {0, 0, 0}, Vec3::Zero(), ball_material());
  return scene;
}

/// A ball falls on a slab that cannot be moved, whose upper side is at height 0.
inline scene::Scene ball_on_slab(std::size_t frames) {
  scene::Scene scene = empty_scene(frames);
  add_body(scene, ball("ball"), {0, 0.15, 0}, Vec3::Zero(), ball_material());
  const TriangleMesh slab = box_mesh({-0.3, -0.05, -0.3}, {0.3, 0.05, 0.3}, 4);
  add_body(scene, make_body("slab", slab, {6, 1, 6}), {0, -0.05, 0}, Vec3::Zero(), std::nullopt);
  return scene;
}

inline Vec3 mean(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

using Frames = std::vector<std::vector<std::vector<Vec3>>>;

inline bool same_bits(const Frames& p, const Frames& q) {
  if (p.size() != q.size()) return false;
  for (std::size_t f = 0; f < p.size(); ++f) {
    if (p[f].size() != q[f].size()) return false;
    for (std::size_t b = 0; b < p[f].size(); ++b)
      if (p[f][b].size() != q[f][b].size() ||
          std::memcmp(p[f][b].data(), q[f][b].data(), p[f][b].size() * sizeof(Vec3)) != 0)
        return false;
  }
  return true;
}

inline const DetectorCatalog& core_catalog() {
  static const DetectorCatalog catalog = [] {
    DetectorCatalog out;
    register_core_detectors(out);
    return out;
  }();
  return catalog;
}

inline std::unique_ptr<Detector> core_detector(const std::string& name) {
  return core_catalog().make(core_catalog().parse(name));
}

/// Answers one question, with nothing; refuses every frame when told to.
class BlindDetector : public Detector {
 public:
  explicit BlindDetector(Question question, bool refuses = false) : refuses_(refuses) {
    semantics_.questions = {question};
  }
  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return false; }
  void prepare(const std::vector<Body>&) override {}
  void update(const Frame& frame) override {
    if (refuses_) throw RefusedInput("a frame it does not like");
    frames_.push_back(frame.index);
  }
  void query(Question question, ContactSet&) override { asked_.push_back(question); }

  /// The indices of the frames that it was given, and what it was asked.
  const std::vector<std::size_t>& frames() const { return frames_; }
  const std::vector<Question>& asked() const { return asked_; }

 private:
  Semantics semantics_;
  bool refuses_;
  std::vector<std::size_t> frames_;
  std::vector<Question> asked_;
};

inline DetectorInfo blind_info(const std::string& id, Question question, bool refuses = false) {
  DetectorInfo info;
  info.id = id;
  info.make = [=](const Options&) { return std::make_unique<BlindDetector>(question, refuses); };
  return info;
}

}  // namespace contactcheck::test
