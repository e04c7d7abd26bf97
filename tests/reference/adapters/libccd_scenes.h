// What the tests of libccd's detectors ask them about.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/reference/adapters/adapter_world.h"

namespace contactcheck::test {

inline constexpr const char* kLibccd[] = {"libccd-gjk", "libccd-mpr"};

inline std::string boxes(const std::string& id, const std::string& more = "") {
  return id + ":pieces=boxes" + more;
}

inline World two_spheres(double size = 1.0) {
  return World({sphere_mesh(size * Vec3(0, 0, 0), size, 3),
                sphere_mesh(size * Vec3(1.1, 0.3, 0.2), 0.9 * size, 3)});
}

inline World two_cubes(const Vec3& second) {
  return World({unit_box_mesh(1), box_mesh(second, second + Vec3::Ones(), 1)});
}

/// Bodies with lattices and where they are.
struct LatticeScene {
  std::vector<Body> bodies;
  FrameData data;
};

inline LatticeScene scene_of(const std::vector<Body>& bodies, const std::vector<Vec3>& offsets) {
  std::vector<std::vector<Vec3>> nodes;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    nodes.push_back(rest_nodes_at(*bodies[b].shape, offsets[b]));
  return {bodies, make_frame(bodies, std::move(nodes))};
}

inline LatticeScene lattice_cubes(const Vec3& second) {
  // This padding makes local coordinates quarters: the mapped corners are exact.
  const Body cube = make_body("cube", unit_box_mesh(1), {1, 1, 1}, 0.5);
  return scene_of({cube, cube}, {Vec3::Zero(), second});
}

/// Two of three are sheared, so that boxes differ from their bounds.
inline LatticeScene lattice_spheres() {
  const Body ball = make_body("ball", sphere_mesh(Vec3(0, 0, 0), 1, 3), {4, 4, 4});
  LatticeScene scene = scene_of({ball, ball, ball},
                                {Vec3(0, 0, 0), Vec3(1.47, 0.31, 0.23), Vec3(0.11, 1.73, -0.17)});
  for (const std::size_t body : {1, 2})
    for (Vec3& n : scene.data.nodes[body]) n.x() += 0.5 * n.y() - 0.3 * n.z();
  scene.data = make_frame(scene.bodies, std::move(scene.data.nodes));
  return scene;
}

inline std::unique_ptr<Detector> prepared(const std::string& name, const LatticeScene& scene) {
  std::unique_ptr<Detector> detector = make_detector(name);
  detector->prepare(scene.bodies);
  detector->update(scene.data.frame());
  return detector;
}

inline ContactSet ask_boxes(const std::string& name, const LatticeScene& scene, Question question) {
  return ask(*prepared(name, scene), question);
}

}  // namespace contactcheck::test
