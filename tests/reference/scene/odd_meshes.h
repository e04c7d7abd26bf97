// Meshes that make it hard to bring two of them into contact, centred on the origin unless said.
#pragma once

#include <map>
#include <string>

#include "tests/support/shapes.h"

namespace contactcheck::test {

/// A square of n x n quads in the plane across an axis.
inline TriangleMesh plate_mesh(int across, int n, double side = 1.0) {
  TriangleMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      Vec3 v = Vec3::Zero();
      v[(across + 1) % 3] = side * (static_cast<double>(i) / n - 0.5);
      v[(across + 2) % 3] = side * (static_cast<double>(j) / n - 0.5);
      mesh.vertices.push_back(v);
    }
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

inline TriangleMesh moved_mesh(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v += by;
  return mesh;
}

inline TriangleMesh open_box_mesh() {
  TriangleMesh mesh = box_mesh(Vec3::Constant(-0.5), Vec3::Constant(0.5), 3);
  mesh.triangles.resize(mesh.triangles.size() - 9);
  return mesh;
}

/// Leans to one side as it goes up: its highest point is no place to be met from above.
inline TriangleMesh leaning_mesh() {
  TriangleMesh mesh = box_mesh(Vec3(-0.05, -0.05, -0.5), Vec3(0.05, 0.05, 0.5), 4);
  for (Vec3& v : mesh.vertices) v.x() += 2.0 * v.z();
  return mesh;
}

inline const std::map<std::string, TriangleMesh>& odd_meshes() {
  static const std::map<std::string, TriangleMesh> meshes = {
      {"box", box_mesh(Vec3::Constant(-0.5), Vec3::Constant(0.5), 3)},
      {"ball", sphere_mesh(Vec3::Zero(), 0.5, 3)},
      {"plate", plate_mesh(2, 4)},
      {"wall", plate_mesh(0, 5)},
      {"open", open_box_mesh()},
      {"rod", box_mesh(Vec3(-0.5, -0.005, -0.005), Vec3(0.5, 0.005, 0.005), 3)},
      {"leaning", leaning_mesh()},
      {"triangle", triangle_mesh(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.2, 0.7, 0))},
      {"skew", triangle_mesh(Vec3(0, 0, 0), Vec3(1, 0.3, -0.4), Vec3(0.2, 0.7, 0.9))},
      {"tiny", sphere_mesh(Vec3::Zero(), 5e-7, 2)},
      {"huge", box_mesh(Vec3::Constant(-5e5), Vec3::Constant(5e5), 3)},
      {"far", moved_mesh(sphere_mesh(Vec3::Zero(), 0.5, 2), Vec3(3e7, -1e8, 2e6))}};
  return meshes;
}

}  // namespace contactcheck::test
