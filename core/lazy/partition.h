// How the triangles of a shape are grouped into the leaves and blocks of its tree.
#pragma once

#include <cstdint>
#include <vector>

#include "core/deform/body.h"

namespace contactcheck {

/// A range of Partition::order; without children a leaf.
struct Part {
  std::uint32_t first = 0, last = 0;
  std::vector<Part> children;
};

struct Partition {
  std::vector<std::uint32_t> order;  ///< triangle indices
  Part root;                         ///< has at least one child
};

/// Parts of several cells are split between cells, parts of one cell at the median along the axis
/// that leaves the smallest boxes, so that nearly all leaves are full. Deterministic.
Partition partition_triangles(const BodyShape& shape);

}  // namespace contactcheck
