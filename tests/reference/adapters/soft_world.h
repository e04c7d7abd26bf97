// What the tests of Bullet's soft bodies add to the worlds of adapters.
#pragma once

#include <cmath>
#include <cstdint>

#include "tests/reference/adapters/adapter_world.h"

namespace contactcheck::test {

inline void shift(World& world, std::size_t body, const Vec3& by) {
  for (Vec3& v : world.vertices[body]) v += by;
}

/// A sphere of rings * 2 rings quads, halved; rows of vertices are in order.
inline TriangleMesh grid_sphere(double radius, std::uint32_t rings) {
  const std::uint32_t segments = 2 * rings, last = (rings - 1) * segments + 1;
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0, 0, radius);
  for (std::uint32_t i = 0; i < (rings - 1) * segments; ++i) {
    const double polar = M_PI * (i / segments + 1) / rings;
    const double around = 2.0 * M_PI * (i % segments) / segments;
    mesh.vertices.push_back(radius * Vec3(std::sin(polar) * std::cos(around),
                                          std::sin(polar) * std::sin(around), std::cos(polar)));
  }
  mesh.vertices.emplace_back(0, 0, -radius);
  const auto at = [&](std::uint32_t ring, std::uint32_t s) {
    return 1 + ring * segments + s % segments;
  };
  for (std::uint32_t s = 0; s < segments; ++s) {
    mesh.triangles.push_back({0, at(0, s), at(0, s + 1)});
    for (std::uint32_t r = 0; r + 2 < rings; ++r) {
      mesh.triangles.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
      mesh.triangles.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
    }
    mesh.triangles.push_back({at(rings - 2, s), last, at(rings - 2, s + 1)});
  }
  return mesh;
}

}  // namespace contactcheck::test
