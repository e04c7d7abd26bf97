// BD-trees: spheres over the triangles of deforming bodies whose centres and radii follow from the
// body's reduced coordinates, here the nodes of its lattice. A sphere is computed when a traversal
// first asks for it, from the nodes alone, whatever became of the spheres above and below and of
// the vertices inside: the cost follows the contact and not the mesh.
// Source: James & Pai: BD-Tree: Output-Sensitive Collision Detection for Reduced Deformable Models,
// ACM TOG 23(3), 2004.
//
// Claim: the closed ball of the stored centre and radius of a sphere contains all mapped vertices
// of its set, and so their triangles. Two triangles that share a point have spheres that share it,
// at every level, and collide_safe() keeps those.
//
// Notation and assumptions:
//   * Lattice nodes are r_j at rest and n_j now.
//   * w_ij are the exact trilinear weights of vertex i from its stored local coordinates: w_ij >=
//     0, sum_j w_ij = 1.
//   * p_i = sum_j w_ij n_j is the exact position of vertex i, q_i = sum_j w_ij r_j the same at
//     rest. (No mesh coordinate enters.)
//   * The sphere of a set of vertices has centre weights m_j >= 0 that sum to 1 exactly (multiples
//     of 2^-50). Its centres are c = sum_j m_j n_j now and g = sum_j m_j r_j at rest.
//   * s_j >= |w_ij - m_j| for every vertex of the set; R >= |q_i - g|.
//   * T(x) = A (x - o) + b is any affine map, and d_j = n_j - T(r_j).
//
// Bounds:
//   * p_i - c = sum_j (w_ij - m_j) n_j = A (q_i - g) + sum_j (w_ij - m_j) d_j              (1)
//     since the differences of weights sum to 0 and so take o and b with them.
//   * paper  |p_i - c| <= |A|_2 R + sum_j s_j |d_j|
//     by (1). This is James & Pai's bound, with one T for the whole body in place of their rest
//     pose. Weights of a lattice are local: for a sphere over many cells the s_j are near 1 and the
//     sum counts every displacement. In a bent or twisted body every region has turned away from T,
//     which small spheres pay for. So two bounds of ours are added, and the least of the three is
//     taken:
//   * hull   |p_i - c| <= max_j |n_j - c|
//     as p_i is a mean of the n_j.
//   * local  |p_i - c| <= |A|_2 R + min(sum_j s_j |d_j|, max_j |d_j|)
//     with T fitted to the sphere's own nodes and T(g) = c. The sum is (1) again; the maximum holds
//     as p_i = T(q_i) + sum_j w_ij d_j.
//   * Each costs a few operations per node that moves the sphere, and none touches a vertex.
//
// Rounding, per coordinate. u = 2^-53, N nodes move the sphere, M is the largest |coordinate| of
// the n_j:
//   * The computed c errs by at most blend_error_bound(N, M), a mapped vertex (map_point) by
//     mapping_error_bound(M).
//   * q_i and g err likewise with the nodes at rest. rest_radius includes that: R holds for the
//     exact and for the computed g. The s_j include the 6 u of computed weights.
//   * T of the body: computed d_j err by at most 16 u (P + M) + 2^-1000, P the largest value met in
//     T(r_j): six roundings, each of a value up to P + M.
//   * T of the sphere is defined by the computed c and g. Its d_j err by six roundings of values up
//     to V = |n_j - c| + sqrt(3) |A|_2 |r_j - g|: at most 16 u V.
//   * A length errs by sqrt(3) < 2 times as much: the slacks.
//   * Norms are rounded up by covering_radius(), which also pays for squares that underflow.
//   * Sums of up to N + 4 terms >= 0 are rounded up by 1 + (N + 8) 2^-52, twice what their
//     roundings can take. Their products do not underflow: spreads are at least 2^-50, norms and
//     radii at least 2^-500.
//
// Single precision, T float. The nodes are floats about the local origin, exactly; vertices are
// mapped in floats, and spheres are stored and compared as floats. What is between, a few
// operations per node that moves a sphere, is done in doubles as above, and all of the above holds.
// (Weights are multiples of 2^-50, which floats have no room for.) Added per coordinate, with v =
// 2^-24:
//   * A vertex is mapped from local coordinates rounded to floats, by at most v / 2 each. Along
//     each axis its exact image changes by at most 2 M over the cell: 3 v M. mapping_error_bound()
//     of floats comes on top.
//   * The centre errs by v M when it is rounded to floats, and by less than the smallest float
//     where it is below their range.
//   * The radius is rounded up. M is at most kSingleLimit, so no centre overflows; a radius does to
//     infinity. collide_safe() has the constants of floats.
//
// Overflow:
//   * A map that overflows is replaced by zero (body) or left out (sphere), so that no NaN hides in
//     a maximum.
//   * A centre beyond the doubles is infinite, and a radius infinite: collide_safe() then excludes
//     nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/broad/bd_model.h"
#include "core/broad/sphere.h"
#include "core/broad/triangle_tree.h"
#include "core/deform/body.h"
#include "core/types/vec3.h"

namespace contactcheck {

struct BdSettings {
  std::uint32_t leaf_size = 4;
  ReferenceKind reference = ReferenceKind::kAffine;
  bool paper_bound = false;  ///< true: James & Pai's bound alone; false: the least of three
  /// Seeded fault for the tests: every radius is multiplied by this. 1 in every real run.
  double fault_radius = 1.0;
};

/// The spheres of one body; T: of doubles or of floats. Not for two threads at once: const members
/// fill caches.
template <typename T>
class BdTreeOf {
 public:
  BdTreeOf(std::shared_ptr<const BdModel> model, const BdSettings& settings);

  /// Fits the reference map and measures the displacements: O(lattice nodes). Reads nothing of an
  /// earlier call. The caller keeps the nodes alive until the next call.
  /// `origin`: what was subtracted from the nodes; it decides how tight ReferenceKind::kNone is,
  /// and no sphere's soundness.
  /// @pre one finite position per lattice node; T float: every coordinate is one, within
  /// kSingleLimit (local_origin.h)
  void begin_frame(std::span<const Vec3> nodes, const Vec3& origin = Vec3::Zero());

  const TriangleTree& tree() const { return model_->tree; }
  const SphereOf<T>& sphere(std::uint32_t node) const {
    if (sphere_frame_[node] != frame_) evaluate(node);
    return spheres_[node];
  }
  bool overlap(std::uint32_t node, const BdTreeOf& other, std::uint32_t other_node) const {
    return collide_safe(sphere(node), other.sphere(other_node));
  }
  T size(std::uint32_t node) const { return sphere(node).radius; }
  /// A vertex of the mesh with the bits of map_point.
  const Vec3Of<T>& vertex(std::uint32_t v) const {
    if (vertex_frame_[v] != frame_) map_vertex(v);
    return vertices_[v];
  }

  /// How many spheres were computed and vertices mapped since begin_frame().
  std::size_t evaluated_spheres() const { return evaluated_spheres_; }
  std::size_t mapped_vertices() const { return mapped_vertices_; }
  /// Returns "", or names a sphere that does not contain one of its vertices. Slow: for tests.
  std::string validate() const;

 private:
  void evaluate(std::uint32_t node) const;
  /// Bounds the error per coordinate of a computed centre plus that of a mapped vertex.
  double coordinate_errors(std::size_t influences) const;
  double paper_radius(const BdSphere& sphere, std::span<const BdInfluence> influences,
                      double errors) const;
  double hull_radius(std::span<const BdInfluence> influences, const Vec3& center,
                     double errors) const;
  double local_radius(const BdSphere& sphere, std::span<const BdInfluence> influences,
                      const Vec3& center, double errors) const;
  void map_vertex(std::uint32_t v) const;

  std::shared_ptr<const BdModel> model_;
  BdSettings settings_;

  std::span<const Vec3> nodes_;
  double stretch_ = 1.0;                // |A|_2, rounded up
  double largest_ = 0.0;                // largest |coordinate| of the nodes
  std::vector<double> residual_norms_;  // rounded up

  std::uint64_t frame_ = 0;  // caches of another frame are stale
  mutable std::vector<std::uint64_t> sphere_frame_, vertex_frame_;
  mutable std::vector<SphereOf<T>> spheres_;
  mutable std::vector<Vec3Of<T>> vertices_;
  mutable std::size_t evaluated_spheres_ = 0, mapped_vertices_ = 0;
};
using BdTree = BdTreeOf<double>;

}  // namespace contactcheck
