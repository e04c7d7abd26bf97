// Where a surface that comes along an axis first touches another one, in doubles: to place bodies,
// not to judge them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/broad/aabb_tree.h"
#include "reference/scene/approach.h"

namespace contactcheck::scene {

/// A surface, moved by an offset from where its vertices and boxes say. References to what the
/// caller keeps.
struct OffsetSurface {
  std::span<const Vec3> vertices;
  const AabbTree& boxes;  ///< fitted to the vertices
  Vec3 offset;

  // Volumes of traverse_pairs().
  const TriangleTree& tree() const { return boxes.tree(); }
  double size(std::uint32_t node) const { return boxes.size(node); }
  Aabb box(std::uint32_t node) const {
    return {boxes.box(node).lo + offset, boxes.box(node).hi + offset};
  }
  bool overlap(std::uint32_t node, const OffsetSurface& other, std::uint32_t other_node) const {
    return box(node).overlaps(other.box(other_node));
  }
};

/// The largest s such that `moving`, further moved by s along the direction `from`, touches
/// `resting`: where it first does as it comes from far away. Only what is above `beyond`; nothing
/// where it passes by. Within rounding, and with the same bits whatever the trees are. Triangles
/// that are seen edge on are left out.
std::optional<double> first_touch(const OffsetSurface& resting, const OffsetSurface& moving,
                                  const AxisDirection& from, double beyond);

/// Exactly: whether they share a point where they are.
bool surfaces_touch(const OffsetSurface& a, const OffsetSurface& b);

}  // namespace contactcheck::scene
