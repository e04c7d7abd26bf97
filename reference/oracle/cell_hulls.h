// The mapped FFD-AABB boxes of a body's kept cells, frame by frame, as convex hulls.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/deform/body.h"
#include "reference/oracle/hull_overlap.h"

namespace contactcheck::oracle {

class CellHulls {
 public:
  /// Finds the boxes at rest, once. A body without a lattice has no boxes.
  explicit CellHulls(std::shared_ptr<const BodyShape> shape);

  /// Maps all boxes by the deformed nodes. Hulls are built on first use.
  void update(std::span<const Vec3> nodes);

  std::size_t size() const { return corners_.size(); }
  const Aabb& bounds() const { return bounds_; }
  const Aabb& box(std::uint32_t cell) const { return boxes_[cell]; }
  const ConvexHull& hull(std::uint32_t cell);

 private:
  std::shared_ptr<const BodyShape> shape_;
  std::vector<Aabb> local_;  // per kept cell, in its own coordinates
  std::vector<Corners> corners_;
  std::vector<Aabb> boxes_;
  std::vector<std::optional<ConvexHull>> hulls_;
  Aabb bounds_;
};

/// A kept cell of one body and one of another.
struct CellPair {
  std::uint32_t a, b;
};

/// Appends every pair of cells whose mapped boxes (closed hulls) share a point; exact, any order.
void overlapping_cells(CellHulls& a, CellHulls& b, std::vector<CellPair>& out);

}  // namespace contactcheck::oracle
