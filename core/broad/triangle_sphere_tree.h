// Trees of bounding spheres over the triangles of deforming bodies: built once at rest, refitted
// from the leaves up in every frame, traversed two at a time.
// Sources: Quinlan: Efficient Distance Computation between Non-Convex Objects, ICRA 1994; Hubbard:
// Approximating Polyhedra with Spheres for Time-Critical Collision Detection, ACM TOG 1996 (spheres
// over the surface's parts, each level round the one below).
//
// A parent takes the smaller of two spheres: the smallest one round its children's, and the one
// round the box of everything below. The first alone grows from level to level: at the root of a
// finely divided ball it is more than twice as large as the ball.
//
// Claim: rounding loses no pair, in doubles and in floats, with the constants of sphere.h for each.
// Two triangles that share a point lie under nodes whose spheres overlap, in their leaves and
// above.
//
// Let B(s) be the exact closed ball of a sphere's centre and radius as they are stored. Each B
// contains all triangles below its node:
//   1. Leaf. covering_radius() is at least the exact distance from the centre to every vertex,
//      whatever number the centre is. So B contains the vertices. It is convex and contains their
//      triangles.
//   2. Parent round its children. Its radius is at least |c - c_i| + r_i, exactly, for both
//      children i, again whatever c is: rounding of c costs tightness, not safety. By the triangle
//      inequality B contains both children's balls, which contain their triangles.
//   3. Parent round a box. Minima and maxima are exact, so the box contains all vertices below. The
//      radius is at least the exact distance to the box's farthest corner, as in 1.
//   4. Two triangles that share a point x lie in balls that all contain x. collide_safe() is true
//      for every two balls that share a point. Hence no pair of nodes above them is ever dropped.
//
// Overflow:
//   * It makes a radius infinite, and such a ball contains everything.
//   * No NaN arises: every step takes maxima and sums of values that are >= 0, and no centre is
//     ever infinite.
//   * Within kSingleLimit of the local origin nothing overflows in floats: squares stay below 2^84.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/broad/sphere.h"
#include "core/broad/triangle_tree.h"
#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// A sphere that contains both, rounded outward: the smallest one up to rounding, or one round the
/// centre of `a` where the distance of the centres overflows.
/// @pre finite centres, radii >= 0 (infinite ones are allowed)
template <typename T>
SphereOf<T> enclosing_sphere(const SphereOf<T>& a, const SphereOf<T>& b);

/// A sphere that contains the box, rounded outward: the smallest one up to rounding.
/// @pre lo <= hi, all finite
template <typename T>
SphereOf<T> enclosing_sphere(const AabbOf<T>& box);

/// The spheres of one body.
template <typename T>
class TriangleSphereTreeOf {
 public:
  explicit TriangleSphereTreeOf(std::shared_ptr<const TriangleTree> tree);

  /// Fits all spheres to the positions. Reads nothing of an earlier call.
  /// @pre one finite position per vertex of the mesh
  void refit(std::span<const Vec3Of<T>> vertices);

  const TriangleTree& tree() const { return *tree_; }
  const SphereOf<T>& sphere(std::uint32_t node) const { return nodes_[node]; }

  bool overlap(std::uint32_t node, const TriangleSphereTreeOf& other,
               std::uint32_t other_node) const {
    return collide_safe(nodes_[node], other.nodes_[other_node]);
  }
  T size(std::uint32_t node) const { return nodes_[node].radius; }

 private:
  void fit_leaf(std::size_t node, std::span<const Vec3Of<T>> vertices);
  void fit_parent(std::size_t node);

  std::shared_ptr<const TriangleTree> tree_;
  std::vector<SphereOf<T>> nodes_;  // parallel to tree_->nodes
  std::vector<AabbOf<T>> boxes_;    // the same
};
using TriangleSphereTree = TriangleSphereTreeOf<double>;

/// One tree per body; the broad phase of a TrianglePairDetector. Candidates: all pairs of triangles
/// of two leaves whose spheres overlap, each pair exactly once.
template <typename T>
class TriangleSphereTreesOf {
 public:
  using Real = T;
  static constexpr const char* kName = "sphere-tree";
  static constexpr const char* kVisitedUnit = "sphere pairs";
  static constexpr bool kBoxesOverlap = false;

  explicit TriangleSphereTreesOf(std::uint32_t leaf_size) : leaf_size_(leaf_size) {}

  void prepare(const std::vector<Body>& bodies);
  /// @pre `vertices`: per prepared body, one finite position per vertex
  void update(const std::vector<std::span<const Vec3Of<T>>>& vertices);
  /// Calls `visit(ElementPair)`; true: the rest of these two bodies is skipped.
  template <typename Visit>
  void visit_candidates(Visit&& visit);
  /// Pairs of spheres that the last traversal compared.
  std::uint64_t visited() const { return visited_; }

  const TriangleSphereTreeOf<T>& tree(std::size_t body) const { return trees_[body]; }

 private:
  std::uint32_t leaf_size_;
  std::vector<TriangleSphereTreeOf<T>> trees_;
  std::vector<NodePair> stack_;
  std::uint64_t visited_ = 0;
};
using TriangleSphereTrees = TriangleSphereTreesOf<double>;

template <typename T>
template <typename Visit>
void TriangleSphereTreesOf<T>::visit_candidates(Visit&& visit) {
  traverse_bodies(trees_, stack_, visited_,
                  [&](BodyPair bodies, std::uint32_t leaf_a, std::uint32_t leaf_b) {
                    return visit_leaf_pairs(bodies, trees_[bodies.a].tree(), leaf_a,
                                            trees_[bodies.b].tree(), leaf_b, visit);
                  });
}

}  // namespace contactcheck
