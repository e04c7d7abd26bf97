// Bodies without lattices that a test moves at will, and their true pairs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/detect/registry.h"
#include "core/narrow/triangle_triangle.h"
#include "reference/adapters/register.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

inline TriangleMesh moved(TriangleMesh mesh, double factor, const Vec3& offset = Vec3::Zero()) {
  for (Vec3& v : mesh.vertices) v = factor * v + offset;
  return mesh;
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

/// The bodies at rest and where they are now.
struct World {
  explicit World(const std::vector<TriangleMesh>& meshes) {
    for (const TriangleMesh& mesh : meshes) {
      bodies.push_back({"body " + std::to_string(bodies.size()), make_bare_shape(mesh)});
      vertices.push_back(mesh.vertices);
    }
  }
  Frame frame() const {
    Frame out;
    for (const std::vector<Vec3>& v : vertices) out.bodies.push_back({v, v});
    return out;
  }
  const std::vector<Triangle>& triangles(std::size_t body) const {
    return bodies[body].shape->mesh.triangles;
  }
  TrianglePoints points(std::size_t body, std::size_t triangle) const {
    const Triangle& t = triangles(body)[triangle];
    return {vertices[body][t[0]], vertices[body][t[1]], vertices[body][t[2]]};
  }

  std::vector<Body> bodies;
  std::vector<std::vector<Vec3>> vertices;
};

/// Turns a body to other axes, and makes it four times as long along one as along another.
inline void stretch(World& world, std::size_t body) {
  for (Vec3& v : world.vertices[body]) v = {2.0 * v.z() + 0.3 * v.y(), v.x(), 0.5 * v.y()};
}

inline void shift(World& world, std::size_t body, const Vec3& by) {
  for (Vec3& v : world.vertices[body]) v += by;
}

/// What a detector in single precision is fed, as doubles.
inline World fed(World world, double scale) {
  for (std::vector<Vec3>& body : world.vertices)
    for (Vec3& v : body)
      v = Vec3(fed_value(v.x(), scale), fed_value(v.y(), scale), fed_value(v.z(), scale));
  return world;
}

/// All pairs, every triangle against every other, by core's exact test; canonical.
inline std::vector<ElementPair> true_pairs(const World& world) {
  std::vector<ElementPair> out;
  for (std::uint32_t a = 0; a < world.bodies.size(); ++a)
    for (std::uint32_t b = a + 1; b < world.bodies.size(); ++b)
      for (std::uint32_t i = 0; i < world.triangles(a).size(); ++i)
        for (std::uint32_t j = 0; j < world.triangles(b).size(); ++j)
          if (triangles_intersect(world.points(a, i), world.points(b, j)))
            out.push_back({a, b, i, j});
  return out;
}

/// Pairs of the first set that the second lacks.
inline std::vector<ElementPair> without(const std::vector<ElementPair>& a,
                                        const std::vector<ElementPair>& b) {
  std::vector<ElementPair> out;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

/// "" when the sets are equal, else counts and one pair with exact coordinates.
inline std::string compare(const World& world, const std::vector<ElementPair>& got) {
  const std::vector<ElementPair> truth = true_pairs(world);
  const std::vector<ElementPair> missed = without(truth, got), spurious = without(got, truth);
  if (missed.empty() && spurious.empty()) return "";
  std::ostringstream out;
  out << missed.size() << " missed, " << spurious.size() << " spurious" << std::hexfloat;
  const ElementPair& p = missed.empty() ? spurious.front() : missed.front();
  out << "\n" << p.body_a << ":" << p.a << " " << p.body_b << ":" << p.b;
  for (const Vec3& v : world.points(p.body_a, p.a)) out << "\n  " << v.transpose();
  for (const Vec3& v : world.points(p.body_b, p.b)) out << "\n  " << v.transpose();
  return out.str();
}

inline std::unique_ptr<Detector> make_detector(const std::string& name) {
  DetectorCatalog catalog;
  adapters::register_reference_detectors(catalog);
  return catalog.make(catalog.parse(name));
}

/// Prepared with the rest shapes and updated to where the bodies are.
inline std::unique_ptr<Detector> prepared(const std::string& name, const World& world) {
  std::unique_ptr<Detector> detector = make_detector(name);
  detector->prepare(world.bodies);
  detector->update(world.frame());
  return detector;
}

inline ContactSet ask(Detector& detector, Question question) {
  ContactSet out;
  detector.query(question, out);
  out.canonicalize();
  return out;
}

/// The answer of a fresh detector.
inline ContactSet ask(const std::string& name, const World& world, Question question) {
  return ask(*prepared(name, world), question);
}

/// Both in one mesh, the vertices of the first before those of the other.
inline TriangleMesh together(TriangleMesh mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [i, j, k] : other.triangles)
    mesh.triangles.push_back({first + i, first + j, first + k});
  return mesh;
}

}  // namespace contactcheck::test
