// Simple solids drawn from a seed, in pairs that cross, hold one another, touch or are apart.
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/mesh.h"
#include "tests/reference/oracle/meshes.h"
#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

/// An L of two arms, closed: [0, 2] x [0, 1] and [0, 1] x [0, 2], from z = 0 to 1.
inline TriangleMesh ell_mesh() {
  constexpr double kRim[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  TriangleMesh mesh;
  for (const double z : {0.0, 1.0})
    for (const auto& p : kRim) mesh.vertices.emplace_back(p[0], p[1], z);
  for (const auto& [b, c] : {std::pair{4u, 5u}, {5u, 0u}, {0u, 1u}, {1u, 2u}}) {
    mesh.triangles.push_back({3, c, b});
    mesh.triangles.push_back({9, b + 6, c + 6});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    mesh.triangles.push_back({i, j, j + 6});
    mesh.triangles.push_back({i, j + 6, i + 6});
  }
  return mesh;
}

inline TriangleMesh tetrahedron_mesh() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

inline TriangleMesh centred_box(const Vec3& half, int n) { return box_mesh(-half, half, n); }

inline constexpr int kSolidKinds = 10;

/// A solid of size about 1, coordinates multiples of 1/64 but for balls and rings.
inline TriangleMesh drawn_solid(TriangleSource& source, int kind) {
  const auto size = [&](double lo, double hi) {
    return std::round(64 * (lo + (hi - lo) * (0.5 + 0.5 * source.unit()))) / 64;
  };
  const int n = 1 + source.below(3);
  switch (kind) {
    case 0:
      return centred_box({size(0.1, 1), size(0.1, 1), size(0.1, 1)}, n);
    case 1:
      return centred_box({size(1.5, 3), size(0.1, 0.5), size(0.1, 0.5)}, n);
    case 2:
      return sphere_mesh(Vec3::Zero(), size(0.3, 1.2), source.below(3));
    case 3:
      return tetrahedron_mesh();
    case 4:
      return ell_mesh();
    case 5:
      return centred_box({size(1, 2), size(1, 2), size(0.02, 0.1)}, n);
    case 6:
      return joined(box_mesh({-1, -1, -1}, {-0.25, 1, 1}, 1),
                    box_mesh({0.125, -0.5, -0.5}, {size(0.5, 2), 0.5, 0.5}, n));
    case 7:
      return joined(box_mesh({-1, -1, -1}, {1, 1, 1}, n),
                    reversed(centred_box(Vec3::Constant(size(0.25, 0.9)), 1)));
    case 8:
      return torus_mesh(1.0, size(0.1, 0.5), 8, 4);
    default:
      return reversed(sphere_mesh(Vec3::Zero(), size(0.3, 1), 1));
  }
}

struct DrawnPair {
  TriangleMesh a, b;
};

/// Turned and set off the grid half of the time; else multiples of 1/64 apart, so that some touch.
inline DrawnPair drawn_pair(TriangleSource& source) {
  constexpr double kScales[] = {1, 1, 1, 1e-150, 1e-37, 1e-3, 3e5, 1e60, 1e150};
  DrawnPair out;
  for (TriangleMesh* mesh : {&out.a, &out.b}) {
    *mesh = drawn_solid(source, source.below(kSolidKinds));
    const bool turned = source.below(2) == 0;
    Vec3 offset = source.point(Vec3::Zero(), mesh == &out.a ? 0.25 : 1.25);
    if (!turned) offset = (16 * offset).array().round() / 16;
    const Eigen::Matrix3d rotation =
        turned ? random_rotation(source) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
    mesh->vertices = moved(mesh->vertices, rotation, offset);
  }
  const double scale = kScales[source.below(9)];
  for (TriangleMesh* mesh : {&out.a, &out.b}) mesh->vertices = scaled(mesh->vertices, scale);
  return out;
}

}  // namespace contactcheck::test
