// The topology of a binary tree over the triangles of one mesh, and the traversal of two such trees
// at once. Trees that use it decide which volumes the nodes have (boxes, spheres).
// Sources: van den Bergen: Efficient Collision Detection of Complex Deformable Models using AABB
// Trees, Journal of Graphics Tools, 1997 (a topology made once, at rest); Wald: On Fast
// Construction of SAH-Based Bounding Volume Hierarchies, RT 2007 (where a node is split).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"
#include "core/types/mesh.h"

namespace contactcheck {

/// Shared by all instances of a mesh; it has no positions. Node 0 is the root; children are next to
/// each other and after their parent, so that a refit is one loop from back to front.
struct TriangleTree {
  struct Node {
    std::uint32_t first = 0;  ///< leaf: its first slot; inner node: its first child
    std::uint32_t count = 0;  ///< leaf: its slots; 0: inner node
    bool leaf() const { return count > 0; }
  };
  std::vector<Node> nodes;
  /// One slot per triangle, the slots of a leaf side by side.
  std::vector<std::uint32_t> ids;  ///< index of the slot's triangle in the mesh
  std::vector<Triangle> corners;   ///< its vertices

  /// Returns "" or what is wrong. Checks: every triangle is in exactly one leaf, children are after
  /// their parent, each node has one parent, corners are those of the mesh.
  std::string validate(const TriangleMesh& mesh) const;
};

/// Built at rest by binned surface-area heuristic, with splits in halves where that finds nothing
/// (equal centroids, overflowing areas) or gets too deep: the depth is at most 2 log2(n) + 32 in
/// the worst case, the time O(n log n). Deterministic: the same tree on every machine.
/// @pre leaf_size >= 1, the mesh has a triangle, all its vertices are finite
TriangleTree make_triangle_tree(const TriangleMesh& mesh, std::uint32_t leaf_size);

/// One tree per body; bodies of one shape share theirs.
std::vector<std::shared_ptr<const TriangleTree>> make_triangle_trees(
    const std::vector<Body>& bodies, std::uint32_t leaf_size);

/// Two nodes, one of each tree.
struct NodePair {
  std::uint32_t a = 0, b = 0;
};

/// Descends two trees together, the larger node first, and calls `leaves(leaf of a, leaf of b)` for
/// every two leaves that overlap, until it returns true. Volumes: `tree()`, `size(node)` (to
/// compare nodes; any value is sound), `overlap(node, other, node of other)`. `stack` is kept by
/// the caller for its capacity; every pair of nodes that is compared adds one to `visited`.
template <typename Volumes, typename Leaves>
void traverse_pairs(const Volumes& a, const Volumes& b, std::vector<NodePair>& stack,
                    std::uint64_t& visited, Leaves&& leaves) {
  stack.clear();
  const auto push = [&](std::uint32_t i, std::uint32_t j) {
    ++visited;
    if (a.overlap(i, b, j)) stack.push_back({i, j});
  };
  push(0, 0);
  while (!stack.empty()) {
    const NodePair pair = stack.back();
    stack.pop_back();
    const TriangleTree::Node& node_a = a.tree().nodes[pair.a];
    const TriangleTree::Node& node_b = b.tree().nodes[pair.b];
    if (node_a.leaf() && node_b.leaf()) {
      if (leaves(pair.a, pair.b)) return;
    } else if (node_b.leaf() || (!node_a.leaf() && a.size(pair.a) >= b.size(pair.b))) {
      push(node_a.first, pair.b);
      push(node_a.first + 1, pair.b);
    } else {
      push(pair.a, node_b.first);
      push(pair.a, node_b.first + 1);
    }
  }
}

/// Descends one tree against itself: calls `leaves(leaf, leaf)` for every two leaves that overlap,
/// once, and for every leaf with itself, until it returns true. Volumes and `visited` as above.
template <typename Volumes, typename Leaves>
void traverse_self(const Volumes& volumes, std::vector<NodePair>& stack, std::uint64_t& visited,
                   Leaves&& leaves) {
  stack.assign(1, {0, 0});
  const auto push = [&](std::uint32_t i, std::uint32_t j) {
    ++visited;
    if (volumes.overlap(i, volumes, j)) stack.push_back({i, j});
  };
  while (!stack.empty()) {
    const NodePair pair = stack.back();
    stack.pop_back();
    const TriangleTree::Node& node_a = volumes.tree().nodes[pair.a];
    const TriangleTree::Node& node_b = volumes.tree().nodes[pair.b];
    if (pair.a == pair.b && !node_a.leaf()) {
      stack.push_back({node_a.first, node_a.first});
      stack.push_back({node_a.first + 1, node_a.first + 1});
      push(node_a.first, node_a.first + 1);
    } else if (node_a.leaf() && node_b.leaf()) {
      if (leaves(pair.a, pair.b)) return;
    } else if (node_b.leaf() || (!node_a.leaf() && volumes.size(pair.a) >= volumes.size(pair.b))) {
      push(node_a.first, pair.b);
      push(node_a.first + 1, pair.b);
    } else {
      push(pair.a, node_b.first);
      push(pair.a, node_b.first + 1);
    }
  }
}

/// Calls traverse_pairs() for every two bodies, one tree of volumes each: calls `leaves(BodyPair,
/// leaf of a, leaf of b)`; true: the rest of these two bodies is skipped. Resets `visited`.
template <typename Volumes, typename Leaves>
void traverse_bodies(const std::vector<Volumes>& trees, std::vector<NodePair>& stack,
                     std::uint64_t& visited, Leaves&& leaves) {
  visited = 0;
  for (std::uint32_t a = 0; a < trees.size(); ++a)
    for (std::uint32_t b = a + 1; b < trees.size(); ++b)
      traverse_pairs(trees[a], trees[b], stack, visited,
                     [&](std::uint32_t leaf_a, std::uint32_t leaf_b) {
                       return leaves(BodyPair{a, b}, leaf_a, leaf_b);
                     });
}

/// Calls `visit(ElementPair)` for every triangle of one leaf with every one of another, until it
/// returns true. Returns whether it did.
template <typename Visit>
bool visit_leaf_pairs(BodyPair bodies, const TriangleTree& a, std::uint32_t leaf_a,
                      const TriangleTree& b, std::uint32_t leaf_b, Visit&& visit) {
  const TriangleTree::Node node_a = a.nodes[leaf_a], node_b = b.nodes[leaf_b];
  for (std::uint32_t i = node_a.first; i < node_a.first + node_a.count; ++i)
    for (std::uint32_t j = node_b.first; j < node_b.first + node_b.count; ++j)
      if (visit(ElementPair{bodies.a, bodies.b, a.ids[i], b.ids[j]})) return true;
  return false;
}

}  // namespace contactcheck
