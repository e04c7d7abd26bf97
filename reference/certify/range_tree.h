// Boxes over ranges of one body's triangles: what the proof that no pair was forgotten speaks of.
//
// The triangles stand in a fixed order; a range of two or more splits in its middle. So a range is
// known by its ends alone, and whoever checks needs the order and no tree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types/mesh.h"
#include "core/types/vec3.h"

namespace contactcheck::certify {

/// The places first .. last of the order, not empty, with the node that holds its box.
struct Range {
  std::size_t node = 0, first = 0, last = 0;

  std::size_t size() const { return last - first; }
  std::size_t middle() const { return first + size() / 2; }
  /// @pre size() > 1, of both. Nodes are numbered in preorder: n triangles below make 2n - 1.
  Range lower_half() const { return {node + 1, first, middle()}; }
  Range upper_half() const { return {node + 2 * (middle() - first), middle(), last}; }
};

class RangeTree {
 public:
  /// An order in which near triangles stand near one another. @pre at least one triangle
  explicit RangeTree(const TriangleMesh& rest);

  /// Boxes for new positions of the vertices.
  void refit(std::span<const Vec3> vertices);

  Range all() const { return {0, 0, order_.size()}; }
  const Aabb& box(const Range& range) const { return boxes_[range.node]; }
  /// Place -> triangle.
  const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  const Aabb& refit(const Range& range, std::span<const Vec3> vertices);

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> order_;
  std::vector<Aabb> boxes_;  // per node
};

}  // namespace contactcheck::certify
