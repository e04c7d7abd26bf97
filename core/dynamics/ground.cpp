#include "core/dynamics/ground.h"

#include <algorithm>
#include <cmath>

#include "core/deform/mapping.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

// Exact values of the mapping are blends of the corners, so no computed one lies lower than the
// lowest corner by more than the mapping's rounding. Rounding the difference is monotone: one that
// comes out above the ground is above it.
bool surely_above(const Corners& corners, const Ground& ground) {
  double lowest = corners[0][ground.axis], largest = 0.0;
  for (const Vec3& corner : corners) {
    lowest = std::min(lowest, corner[ground.axis]);
    largest = std::max(largest, std::abs(corner[ground.axis]));
  }
  return lowest - mapping_error_bound(largest) > ground.height;
}

void add_held_of_cell(const Embedding& embedding, std::uint32_t cell, const Corners& corners,
                      const Ground& ground, std::vector<std::uint32_t>& out) {
  for (std::uint32_t i = embedding.cell_begin[cell]; i < embedding.cell_begin[cell + 1]; ++i) {
    const std::uint32_t vertex = embedding.cell_order[i];
    if (ground.holds(map_point(corners, embedding.local[vertex]))) out.push_back(vertex);
  }
}

}  // namespace

std::vector<std::uint32_t> vertices_in_ground(const BodyShape& shape, std::span<const Vec3> nodes,
                                              const Ground& ground) {
  CONTACTCHECK_INVARIANT(nodes.size() == shape.node_count(), "one position per node");
  std::vector<std::uint32_t> held;
  if (!shape.lattice) {
    for (std::uint32_t v = 0; v < nodes.size(); ++v)
      if (ground.holds(nodes[v])) held.push_back(v);
    return held;
  }
  for (std::uint32_t cell = 0; cell < shape.lattice->cells.size(); ++cell) {
    const Corners corners = corners_of(*shape.lattice, cell, nodes);
    if (!surely_above(corners, ground))
      add_held_of_cell(shape.embedding, cell, corners, ground, held);
  }
  std::sort(held.begin(), held.end());
  return held;
}

}  // namespace contactcheck
