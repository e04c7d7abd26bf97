// One body as a soft body of Bullet that is fed with vertices and never stepped. Holds Bullet's
// types: for the .cpp files of the adapters of soft bodies alone.
#pragma once

#include <BulletSoftBody/btSoftBody.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/types/mesh.h"

namespace contactcheck {

inline Vec3 wide(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// What a soft body is made with.
struct SoftBodySettings {
  double scale = 1.0;   ///< world units per metre
  float margin = 0.0f;  ///< of this body, world units
  int collisions = 0;   ///< Bullet's flags: VF_SS or CL_SS
};

/// The world that soft bodies are made in. They are queried in pairs and never stepped: there is
/// neither a dispatcher nor a broad phase, and no field of it has a part in an answer. One per
/// detector, so that detectors share nothing.
struct SoftBodyWorld {
  SoftBodyWorld() { info.m_sparsesdf.Initialize(); }
  btSoftBodyWorldInfo info;
};

/// A node of mass 1 per vertex, a face per triangle that does not repeat an index; no links.
class SoftBody {
 public:
  /// Takes time of order n log n and memory of order n, connected or not, however vertices
  /// coincide.
  /// @pre world outlives it
  /// @throws RefusedInput as feed() does
  SoftBody(SoftBodyWorld& world, const TriangleMesh& rest, const SoftBodySettings& settings);

  /// Moves every node to float(scale * x), without velocity or memory of where it was.
  /// @throws RefusedInput when a coordinate is not finite as a float
  void feed(std::span<const Vec3> vertices);

  /// For VF_SS: trees of nodes and of faces around the positions last fed.
  void build_trees();
  /// The same trees around new positions.
  void refit_trees();

  btSoftBody& bullet() { return *body_; }
  /// Closed; of the boxes grown by the margins, as Bullet's broad phase compares them.
  bool boxes_meet(const SoftBody& other) const;

  /// Indices of the input mesh.
  std::uint32_t vertex_of(const btSoftBody::Node& node) const;
  std::uint32_t triangle_of(const btSoftBody::Face& face) const;

  /// True when a triangle that has area is none to Bullet where it was last fed.
  bool has_invisible_triangle() const;

 private:
  void append_nodes(std::size_t count);
  void append_faces(const std::vector<Triangle>& triangles);

  double scale_;
  std::unique_ptr<btSoftBody> body_;
  std::vector<std::uint32_t> triangle_of_face_;
};

/// The sum of the margins of two bodies in metres, as Bullet compares it: each of `margin` metres,
/// scaled and rounded to float; the sum of two equal floats is exact.
double sum_of_margins(double margin, double scale);

/// The sentence on triangles that the area cut hides, at this scale.
std::string invisible_triangles_note(double scale);

}  // namespace contactcheck
