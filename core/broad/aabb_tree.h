// Trees of axis-aligned boxes over the triangles of deforming bodies: built once at rest, refitted
// from the leaves up in every frame, traversed two at a time.
// Source: van den Bergen: Efficient Collision Detection of Complex Deformable Models using AABB
// Trees, Journal of Graphics Tools, 1997.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/broad/triangle_tree.h"
#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// The boxes of one body. Minima and maxima of doubles, as of floats, are exact, so the boxes are
/// the tightest ones and nothing has to be rounded outward.
template <typename T>
class AabbTreeOf {
 public:
  explicit AabbTreeOf(std::shared_ptr<const TriangleTree> tree);

  /// Fits all boxes to the positions. Reads nothing of an earlier call.
  /// @pre one finite position per vertex of the mesh
  void refit(std::span<const Vec3Of<T>> vertices);
  /// The same to the positions at both ends of a step.
  void refit(std::span<const Vec3Of<T>> start, std::span<const Vec3Of<T>> end);

  const TriangleTree& tree() const { return *tree_; }
  const AabbOf<T>& box(std::uint32_t node) const { return nodes_[node]; }
  /// The box of the triangle in `slot` of the tree.
  const AabbOf<T>& triangle_box(std::uint32_t slot) const { return triangles_[slot]; }

  bool overlap(std::uint32_t node, const AabbTreeOf& other, std::uint32_t other_node) const {
    return nodes_[node].overlaps(other.nodes_[other_node]);
  }
  /// Sum of the edges; infinite where they overflow.
  T size(std::uint32_t node) const {
    const Vec3Of<T> extent = nodes_[node].extent();
    return extent.x() + extent.y() + extent.z();
  }

  /// Returns "", or names a box that does not contain what it must. Slow: for tests.
  std::string validate(std::span<const Vec3Of<T>> vertices) const;

 private:
  void refit_nodes();

  std::shared_ptr<const TriangleTree> tree_;
  std::vector<AabbOf<T>> nodes_;      // parallel to tree_->nodes
  std::vector<AabbOf<T>> triangles_;  // per slot, so those of a leaf are read in one go
};
using AabbTree = AabbTreeOf<double>;

/// One tree per body; the broad phase of a TrianglePairDetector. Candidates: pairs of triangles
/// whose boxes overlap, each exactly once.
template <typename T>
class AabbTreesOf {
 public:
  using Real = T;
  static constexpr const char* kName = "aabb-tree";
  static constexpr const char* kVisitedUnit = "box pairs";
  static constexpr bool kBoxesOverlap = true;

  explicit AabbTreesOf(std::uint32_t leaf_size) : leaf_size_(leaf_size) {}

  void prepare(const std::vector<Body>& bodies);
  /// @pre `vertices`: per prepared body, one finite position per vertex
  void update(const std::vector<std::span<const Vec3Of<T>>>& vertices);
  /// The same of both ends of a step.
  void update(const std::vector<std::span<const Vec3Of<T>>>& start,
              const std::vector<std::span<const Vec3Of<T>>>& end);
  /// Calls `visit(ElementPair)`; true: the rest of these two bodies is skipped.
  template <typename Visit>
  void visit_candidates(Visit&& visit);
  /// The same for two triangles of one body: calls `visit(SelfPair)`, in either order of the two;
  /// true: the rest of this body is skipped.
  template <typename Visit>
  void visit_own_candidates(Visit&& visit);
  /// Pairs of boxes, of nodes and of triangles, that the last traversal compared.
  std::uint64_t visited() const { return visited_; }

  const AabbTreeOf<T>& tree(std::size_t body) const { return trees_[body]; }

 private:
  template <typename Visit>
  bool visit_leaves(BodyPair bodies, std::uint32_t leaf_a, std::uint32_t leaf_b, Visit& visit);

  std::uint32_t leaf_size_;
  std::vector<AabbTreeOf<T>> trees_;
  std::vector<NodePair> stack_;
  std::uint64_t visited_ = 0;
};
using AabbTrees = AabbTreesOf<double>;

template <typename T>
template <typename Visit>
void AabbTreesOf<T>::visit_candidates(Visit&& visit) {
  traverse_bodies(trees_, stack_, visited_,
                  [&](BodyPair bodies, std::uint32_t leaf_a, std::uint32_t leaf_b) {
                    return visit_leaves(bodies, leaf_a, leaf_b, visit);
                  });
}

template <typename T>
template <typename Visit>
void AabbTreesOf<T>::visit_own_candidates(Visit&& visit) {
  visited_ = 0;
  for (std::uint32_t body = 0; body < trees_.size(); ++body) {
    const AabbTreeOf<T>& volumes = trees_[body];
    const TriangleTree& tree = volumes.tree();
    traverse_self(volumes, stack_, visited_, [&](std::uint32_t leaf_a, std::uint32_t leaf_b) {
      const TriangleTree::Node a = tree.nodes[leaf_a], b = tree.nodes[leaf_b];
      for (std::uint32_t i = a.first; i < a.first + a.count; ++i)
        for (std::uint32_t j = leaf_a == leaf_b ? i + 1 : b.first; j < b.first + b.count; ++j) {
          ++visited_;
          if (volumes.triangle_box(i).overlaps(volumes.triangle_box(j)) &&
              visit(SelfPair{body, tree.ids[i], tree.ids[j]}))
            return true;
        }
      return false;
    });
  }
}

template <typename T>
template <typename Visit>
bool AabbTreesOf<T>::visit_leaves(BodyPair bodies, std::uint32_t leaf_a, std::uint32_t leaf_b,
                                  Visit& visit) {
  const AabbTreeOf<T>& a = trees_[bodies.a];
  const AabbTreeOf<T>& b = trees_[bodies.b];
  const TriangleTree::Node node_a = a.tree().nodes[leaf_a], node_b = b.tree().nodes[leaf_b];
  const AabbOf<T>& whole_b = b.box(leaf_b);
  visited_ += node_a.count;
  for (std::uint32_t i = node_a.first; i < node_a.first + node_a.count; ++i) {
    const AabbOf<T>& box = a.triangle_box(i);
    if (!box.overlaps(whole_b)) continue;
    visited_ += node_b.count;
    for (std::uint32_t j = node_b.first; j < node_b.first + node_b.count; ++j)
      if (box.overlaps(b.triangle_box(j)) &&
          visit(ElementPair{bodies.a, bodies.b, a.tree().ids[i], b.tree().ids[j]}))
        return true;
  }
  return false;
}

}  // namespace contactcheck
