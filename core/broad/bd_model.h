// What a BD-tree prepares once per shape: for every sphere the lattice nodes that move it, with the
// weights of its centre and the largest weight differences of its vertices. bd_tree.h derives the
// bounds from these, with a proof.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/broad/reference_map.h"
#include "core/broad/triangle_tree.h"
#include "core/deform/body.h"

namespace contactcheck {

/// How one lattice node moves one sphere.
struct BdInfluence {
  std::uint32_t node = 0;
  double weight = 0.0;  ///< in the centre: a multiple of 2^-50; those of a sphere sum to 1 exactly
  double spread = 0.0;  ///< not below |weight of a vertex - weight|, over the sphere's vertices
};

struct BdSphere {
  std::uint32_t first = 0, count = 0;  ///< range in BdModel::influences
  Vec3 rest_center = Vec3::Zero();     ///< metres; weighted mean of the nodes at rest
  double rest_radius = 0.0;            ///< metres; valid about rest_center and the exact mean
  /// The inverse of the sum of (r - c)(r - c)^T over its nodes at rest, for a least-squares map.
  Eigen::Matrix3d inverse_moment = Eigen::Matrix3d::Zero();
};

struct BdModel {
  const BodyShape* shape = nullptr;
  TriangleTree tree;
  ReferenceFit reference;         ///< for the lattice's nodes
  std::vector<BdSphere> spheres;  ///< parallel to tree.nodes
  std::vector<BdInfluence> influences;

  std::span<const BdInfluence> influences_of(std::uint32_t node) const {
    return std::span(influences).subspan(spheres[node].first, spheres[node].count);
  }
};

/// The eight trilinear weights of local coordinates, in the order of a cell's corners. Each is
/// within 6 * 2^-53 of the exact weight: three factors 1 - x and two products round, values of at
/// most 1.
std::array<double, 8> corner_weights(const Vec3& local);

/// Bound on |computed - exact| per coordinate of the sum of weight * position over `count` nodes,
/// with weights >= 0 that sum to 1 and coordinates up to `largest`:
///   * Products are at most weight * largest and round by 2^-53 of that, together 2^-53 of largest.
///   * Each of the count - 1 additions that round stays below largest and rounds by 2^-53 of it.
///   * Together count * 2^-53 of largest. Twice that covers terms of higher order.
///   * Products may underflow: 2^-1000 covers that.
inline double blend_error_bound(std::size_t count, double largest) {
  return static_cast<double>(count) * 0x1p-52 * largest + 0x1p-1000;
}

/// @throws RefusedInput when the shape has no lattice, or more influences than 32 bits can number
/// @pre leaf_size >= 1, the mesh has a triangle
std::shared_ptr<const BdModel> make_bd_model(const BodyShape& shape, std::uint32_t leaf_size);

/// One model per body; bodies of one shape share theirs.
/// @throws RefusedInput naming the first body that make_bd_model() refuses
std::vector<std::shared_ptr<const BdModel>> make_bd_models(const std::vector<Body>& bodies,
                                                           std::uint32_t leaf_size);

}  // namespace contactcheck
