// Where a surface that approaches along an axis first touches another one, in doubles: used to
// place bodies, not to judge them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/broad/aabb_tree.h"
#include "reference/scene/approach.h"

namespace contactcheck::scene {

/// A surface with an offset added to its vertices and boxes. Refers to the caller's data.
struct OffsetSurface {
  std::span<const Vec3> vertices;
  const AabbTree& boxes;  ///< fitted to the vertices
  Vec3 offset;

  // The interface that traverse_pairs() needs.
  const TriangleTree& tree() const { return boxes.tree(); }
  double size(std::uint32_t node) const { return boxes.size(node); }
  Aabb box(std::uint32_t node) const {
    return {boxes.box(node).lo + offset, boxes.box(node).hi + offset};
  }
  bool overlap(std::uint32_t node, const OffsetSurface& other, std::uint32_t other_node) const {
    return box(node).overlaps(other.box(other_node));
  }
};

/// The largest s such that `moving`, translated by s along `from`, touches `resting`: the first
/// touch when it comes from far away. Only values above `beyond`; nothing if it passes by. Exact up
/// to rounding, with the same bits for all trees. Triangles seen edge-on are left out.
std::optional<double> first_touch(const OffsetSurface& resting, const OffsetSurface& moving,
                                  const AxisDirection& from, double beyond);

/// Exact: true if the surfaces share a point at their offsets.
bool surfaces_touch(const OffsetSurface& a, const OffsetSurface& b);

}  // namespace contactcheck::scene
