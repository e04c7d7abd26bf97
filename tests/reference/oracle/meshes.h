// Closed meshes and moves for the oracle's tests; no libm on the way to a coordinate.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "core/deform/body.h"
#include "core/types/mesh.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {

inline Body bare_body(const std::string& name, TriangleMesh mesh) {
  return {name, make_bare_shape(std::move(mesh))};
}

/// Points on the unit circle by rational parametrisation, counter-clockwise from (1, 0).
inline std::vector<Eigen::Vector2d> circle_points(int count) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < count; ++i) {
    // s in [-1, 1) round each half: (1 - s^2, 2 s) / (1 + s^2) covers the right half, its mirror
    // image the left one.
    const double turn = 4.0 * i / count;
    const double s = turn < 2 ? turn - 1 : turn - 3, scale = 1 / (1 + s * s);
    const Eigen::Vector2d p((1 - s * s) * scale, 2 * s * scale);
    points.push_back(turn < 2 ? p : Eigen::Vector2d(-p));
  }
  return points;
}

/// A torus about the z axis: `around` x `across` quads of two triangles, outward-oriented.
inline TriangleMesh torus_mesh(double ring, double tube, int around, int across) {
  TriangleMesh mesh;
  const auto big = circle_points(around), small = circle_points(across);
  for (const auto& u : big)
    for (const auto& v : small) {
      const double r = ring + tube * v.x();
      mesh.vertices.emplace_back(r * u.x(), r * u.y(), tube * v.y());
    }
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % around) * across + j % across);
  };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

/// Both meshes in one, each keeping its vertices.
inline TriangleMesh joined(TriangleMesh mesh, const TriangleMesh& other) {
  const auto shift = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& t : other.triangles)
    mesh.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return mesh;
}

/// Every triangle has its own corners, as in STL files.
inline TriangleMesh with_own_corners(const TriangleMesh& mesh) {
  TriangleMesh out;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(out.vertices.size());
    for (const std::uint32_t v : t) out.vertices.push_back(mesh.vertices[v]);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

/// The same surface with its inside out.
inline TriangleMesh reversed(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// The boundaries of random tetrahedra with corners on one small grid, which share vertices: a
/// closed chain with any number of sheets on an edge, duplicates in both directions, flat
/// tetrahedra, and triangles of no area.
inline TriangleMesh tetrahedra_on_a_grid(TriangleSource& source, int count, int side) {
  TriangleMesh mesh;
  const auto vertex = [&mesh](const Vec3& p) {
    const auto found = std::find(mesh.vertices.begin(), mesh.vertices.end(), p);
    const auto index = static_cast<std::uint32_t>(found - mesh.vertices.begin());
    if (found == mesh.vertices.end()) mesh.vertices.push_back(p);
    return index;
  };
  for (int i = 0; i < count; ++i) {
    std::array<std::uint32_t, 4> v{};
    for (std::uint32_t& corner : v) corner = vertex(source.grid_point(side));
    for (const Triangle& t : {Triangle{v[0], v[2], v[1]}, Triangle{v[0], v[1], v[3]},
                              Triangle{v[1], v[2], v[3]}, Triangle{v[0], v[3], v[2]}})
      mesh.triangles.push_back(t);
  }
  return mesh;
}

/// A rotation from a random quaternion; orthogonal up to rounding.
inline Eigen::Matrix3d random_rotation(TriangleSource& source) {
  const double w = source.unit(), x = source.unit(), y = source.unit();
  return Eigen::Quaterniond(w, x, y, source.unit()).normalized().toRotationMatrix();
}

inline std::vector<Vec3> moved(std::span<const Vec3> points, const Eigen::Matrix3d& linear,
                               const Vec3& offset) {
  std::vector<Vec3> out;
  for (const Vec3& p : points) out.push_back(linear * p + offset);
  return out;
}

inline std::vector<Vec3> scaled(std::span<const Vec3> points, double factor) {
  std::vector<Vec3> out;
  for (const Vec3& p : points) out.push_back(p * factor);
  return out;
}

/// Pasteable: hexadecimal floating point keeps every bit.
inline std::string hex_points(std::span<const Vec3> points) {
  std::ostringstream out;
  out << std::hexfloat;
  for (const Vec3& c : points) out << "{" << c.x() << ", " << c.y() << ", " << c.z() << "}, ";
  return out.str();
}

}  // namespace contactcheck::test
