// Small scenes of deformed bodies with their truth, for the tests of the detectors.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

struct Scene {
  std::vector<Body> bodies;
  std::vector<FrameData> frames;
};

struct SceneSettings {
  std::uint64_t seed = 1;
  double strength = 0.4;  ///< lattice nodes move by up to this, per axis; a cell is about 0.5
  double scale = 1.0;     ///< of everything
  Vec3 offset = Vec3::Zero();
};

/// Two spheres, or a sphere and a box, or two boxes (by the seed), about 2 wide, of which one comes
/// nearer in `frames` steps, from apart to deep inside. Every frame has its own deformation.
Scene approach(const SceneSettings& settings, int frames = 6);

/// As approach(), for three bodies.
Scene three_bodies(const SceneSettings& settings);

/// Two boxes of which every coordinate and local coordinate is a short binary fraction, moved by
/// such: mapping is exact. `shift` moves both. Frames: apart, touching faces, overlapping.
Scene exact_boxes(const Vec3& shift, double scale = 1.0);

/// Every intersecting pair of triangles of different bodies, canonical.
std::vector<ElementPair> true_pairs(const Scene& scene, const FrameData& frame);

/// The ids of the family, without and with the triangle test.
std::vector<std::string> family();
std::vector<std::string> family_with_triangles();

/// All of core's that claim to be exact and take lattices: the family's, and ffd-lazy with every
/// source of bounds and on every instruction set of this machine.
std::vector<std::string> exact_detectors();

/// A detector of core by name, prepared for the scene.
std::unique_ptr<Detector> prepared(const std::string& name, const Scene& scene);

/// Update and query; canonical.
ContactSet answer(Detector& detector, const FrameData& frame, Question question);
/// The same, of the detector's own question.
ContactSet answer(Detector& detector, const FrameData& frame);

}  // namespace contactcheck::test
