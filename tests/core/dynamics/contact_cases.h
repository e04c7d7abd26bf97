// Contacts for tests of the response: what a detector would report, by brute force, and blends
// taken apart.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/dynamics/contact_point.h"
#include "core/dynamics/deformable.h"
#include "core/narrow/triangle_triangle.h"
#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

inline Vec3 blended(const NodeBlend& blend, std::span<const Vec3> nodes) {
  Vec3 out = Vec3::Zero();
  for (std::size_t i = 0; i < blend.nodes.size(); ++i)
    out += blend.weights[i] * nodes[blend.nodes[i]];
  return out;
}

inline bool same_bits(const std::vector<Vec3>& p, const std::vector<Vec3>& q) {
  return p.size() == q.size() && std::memcmp(p.data(), q.data(), p.size() * sizeof(Vec3)) == 0;
}

inline bool same_bits(const NodeState& x, const NodeState& y) {
  return same_bits(x.positions, y.positions) && same_bits(x.velocities, y.velocities);
}

/// Of the first `nodes` nodes, with weights that are not negative and sum to 1.
inline NodeBlend random_blend(TriangleSource& random, std::uint32_t nodes) {
  NodeBlend blend;
  double sum = 0.0;
  for (std::uint32_t n = 0; n < nodes; ++n) {
    blend.nodes.push_back(n);
    blend.weights.push_back(std::abs(random.unit()));
    sum += blend.weights.back();
  }
  for (double& weight : blend.weights) weight /= sum;
  return blend;
}

inline double weight_sum(const NodeBlend& blend) {
  double sum = 0.0;
  for (double weight : blend.weights) sum += weight;
  return sum;
}

inline TrianglePoints points_of(const Body& body, std::span<const Vec3> vertices,
                                std::uint32_t triangle) {
  const Triangle& t = body.shape->mesh.triangles[triangle];
  return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
}

/// Every pair of triangles of bodies 0 and 1 that share a point.
inline ContactSet triangle_contacts(const std::vector<Body>& bodies, const Frame& frame) {
  ContactSet out;
  const auto count = [&](int b) {
    return static_cast<std::uint32_t>(bodies[b].shape->mesh.triangles.size());
  };
  for (std::uint32_t i = 0; i < count(0); ++i)
    for (std::uint32_t j = 0; j < count(1); ++j)
      if (triangles_intersect(points_of(bodies[0], frame.bodies[0].vertices, i),
                              points_of(bodies[1], frame.bodies[1].vertices, j)))
        out.triangles.push_back({0, 1, i, j});
  out.canonicalize();
  return out;
}

/// Every pair of cells of bodies 0 and 1.
inline ContactSet all_cells(const std::vector<Body>& bodies) {
  ContactSet out;
  for (std::uint32_t i = 0; i < bodies[0].shape->lattice->cells.size(); ++i)
    for (std::uint32_t j = 0; j < bodies[1].shape->lattice->cells.size(); ++j)
      out.cells.push_back({0, 1, i, j});
  out.canonicalize();
  return out;
}

}  // namespace contactcheck::test
