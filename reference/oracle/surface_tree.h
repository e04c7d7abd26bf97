// The oracle's own box tree over the triangles of one surface: built once, boxes refitted.
//
// Split by the median of the rest centroids along the longest side; refitted bottom-up. Boxes are
// the exact bounds of the vertices and only comparisons decide, so that no candidate is missed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/types/mesh.h"
#include "core/types/vec3.h"
#include "reference/oracle/exact_predicates.h"

namespace contactcheck::oracle {

class SurfaceTree {
 public:
  /// A leaf contains the places first .. first + count. An inner node has count 0; its children are
  /// the next node and `second`.
  struct Node {
    Aabb box;
    std::uint32_t first = 0, count = 0, second = 0;
    bool is_leaf() const { return count > 0; }
  };

  /// @pre at least one triangle, indices in range
  explicit SurfaceTree(const TriangleMesh& rest);

  /// Fits the boxes to new vertices; the span must outlive its use.
  void refit(std::span<const Vec3> vertices) { refit(vertices, vertices); }
  /// Fits the boxes to both ends of a step; corners() are those of its start.
  void refit(std::span<const Vec3> start, std::span<const Vec3> end);

  const Aabb& bounds() const { return nodes_.front().box; }
  const Node& node(std::uint32_t index) const { return nodes_[index]; }
  /// The triangle at a place of a leaf, and its box.
  std::uint32_t triangle_at(std::uint32_t place) const { return order_[place]; }
  const Aabb& box_at(std::uint32_t place) const { return boxes_[place]; }
  TriangleCorners corners(std::uint32_t triangle) const { return corners(triangle, vertices_); }
  /// The corners at other positions of the same mesh.
  TriangleCorners corners(std::uint32_t triangle, std::span<const Vec3> vertices) const {
    const Triangle& t = triangles_[triangle];
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  }
  /// True when every node's box contains its children's and every leaf's its triangles'.
  bool validate() const;

 private:
  std::uint32_t build(std::uint32_t first, std::uint32_t last, const std::vector<Vec3>& centroids);

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> order_;  // place -> triangle
  std::vector<Aabb> boxes_;           // per place
  std::vector<Node> nodes_;           // children after their parent
  std::span<const Vec3> vertices_;
};

/// Calls `visit(triangle)` for triangles whose closed box satisfies `meets(box)`. If `meets`
/// accepts a box, it must accept every box around it. Stops and returns true when `visit` does.
template <typename Meets, typename Visit>
bool any_triangle(const SurfaceTree& tree, Meets&& meets, Visit&& visit, std::uint32_t index = 0) {
  const SurfaceTree::Node& node = tree.node(index);
  if (!meets(node.box)) return false;
  if (!node.is_leaf()) {
    return any_triangle(tree, meets, visit, index + 1) ||
           any_triangle(tree, meets, visit, node.second);
  }
  for (std::uint32_t place = node.first; place < node.first + node.count; ++place)
    if (meets(tree.box_at(place)) && visit(tree.triangle_at(place))) return true;
  return false;
}

/// Calls `visit(triangle of a, triangle of b)` once for every pair whose closed boxes satisfy
/// `meets(box, box)`. If `meets` accepts two boxes, it must accept all boxes around them. Stops and
/// returns true when `visit` does.
template <typename Meets, typename Visit>
bool any_pair(const SurfaceTree& a, const SurfaceTree& b, Meets&& meets, Visit&& visit,
              std::uint32_t i = 0, std::uint32_t j = 0) {
  const SurfaceTree::Node &x = a.node(i), &y = b.node(j);
  if (!meets(x.box, y.box)) return false;
  if (x.is_leaf() && y.is_leaf()) {
    for (std::uint32_t p = x.first; p < x.first + x.count; ++p) {
      if (!meets(a.box_at(p), y.box)) continue;
      for (std::uint32_t q = y.first; q < y.first + y.count; ++q)
        if (meets(a.box_at(p), b.box_at(q)) && visit(a.triangle_at(p), b.triangle_at(q)))
          return true;
    }
    return false;
  }
  const bool split_first =
      y.is_leaf() || (!x.is_leaf() && x.box.extent().maxCoeff() >= y.box.extent().maxCoeff());
  if (split_first)
    return any_pair(a, b, meets, visit, i + 1, j) || any_pair(a, b, meets, visit, x.second, j);
  return any_pair(a, b, meets, visit, i, j + 1) || any_pair(a, b, meets, visit, i, y.second);
}

/// The same for pairs whose boxes overlap.
template <typename Visit>
bool any_box_pair(const SurfaceTree& a, const SurfaceTree& b, Visit&& visit, std::uint32_t i = 0,
                  std::uint32_t j = 0) {
  const auto overlap = [](const Aabb& x, const Aabb& y) { return x.overlaps(y); };
  return any_pair(a, b, overlap, visit, i, j);
}

/// Calls `visit(triangle, triangle)` once for every two triangles of the surface whose closed boxes
/// overlap, in either order. Stops and returns true when `visit` does.
template <typename Visit>
bool any_own_box_pair(const SurfaceTree& tree, Visit&& visit, std::uint32_t index = 0) {
  const SurfaceTree::Node& node = tree.node(index);
  if (!node.is_leaf())
    return any_own_box_pair(tree, visit, index + 1) || any_own_box_pair(tree, visit, node.second) ||
           any_box_pair(tree, tree, visit, index + 1, node.second);
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
    for (std::uint32_t j = node.first; j < i; ++j)
      if (tree.box_at(i).overlaps(tree.box_at(j)) &&
          visit(tree.triangle_at(i), tree.triangle_at(j)))
        return true;
  return false;
}

}  // namespace contactcheck::oracle
