// Scenes of bodies without lattices, whose vertices a test moves as it likes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/core/detect/scenes.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {

inline FrameData at_rest(const std::vector<Body>& bodies) {
  FrameData frame;
  for (const Body& body : bodies) frame.nodes.push_back(body.shape->mesh.vertices);
  frame.vertices = frame.nodes;
  return frame;
}

/// Bodies without lattices; one frame, at rest.
inline Scene still(const std::vector<TriangleMesh>& meshes) {
  Scene scene;
  for (const TriangleMesh& mesh : meshes)
    scene.bodies.push_back({"body " + std::to_string(scene.bodies.size()), make_bare_shape(mesh)});
  scene.frames = {at_rest(scene.bodies)};
  return scene;
}

inline TriangleMesh soup(const std::vector<TrianglePoints>& triangles) {
  TriangleMesh mesh;
  for (const TrianglePoints& t : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), t.begin(), t.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// Integer corners: many touch, are coplanar or degenerate.
inline TriangleMesh grid_soup(TriangleSource& random, int count, int limit) {
  std::vector<TrianglePoints> triangles;
  for (int i = 0; i < count; ++i) {
    TrianglePoints t = random.grid_triangle(1);
    const Vec3 at = random.grid_point(limit);
    for (Vec3& p : t) p += at;
    triangles.push_back(t);
  }
  return soup(triangles);
}

inline TriangleMesh generic_soup(TriangleSource& random, int count) {
  std::vector<TrianglePoints> triangles;
  for (int i = 0; i < count; ++i)
    triangles.push_back(random.triangle(random.point(Vec3::Zero(), 1.0), i % 8 == 0 ? 1.0 : 0.35));
  return soup(triangles);
}

inline TriangleMesh scaled(TriangleMesh mesh, double scale, const Vec3& offset = Vec3::Zero()) {
  for (Vec3& v : mesh.vertices) v = scale * v + offset;
  return mesh;
}

}  // namespace contactcheck::test
