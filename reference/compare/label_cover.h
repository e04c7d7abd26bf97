// Reading triangle pairs through the labels of their cells.
#pragma once

#include <algorithm>
#include <vector>

#include "core/deform/body.h"
#include "core/types/contact_set.h"

namespace contactcheck {

/// True when some pair of cells in `cells` (canonical) belongs to the labels of the two triangles.
/// Calls `used(index into cells)` for each such pair.
template <typename Used>
bool covered_by_cells(const std::vector<Body>& bodies, const std::vector<ElementPair>& cells,
                      const ElementPair& triangles, Used&& used) {
  bool covered = false;
  const Embedding& first = bodies[triangles.body_a].shape->embedding;
  const Embedding& second = bodies[triangles.body_b].shape->embedding;
  for (std::uint32_t a : first.cells_of_triangle(triangles.a)) {
    for (std::uint32_t b : second.cells_of_triangle(triangles.b)) {
      const ElementPair pair{triangles.body_a, triangles.body_b, a, b};
      const auto it = std::lower_bound(cells.begin(), cells.end(), pair);
      if (it == cells.end() || *it != pair) continue;
      covered = true;
      used(static_cast<std::size_t>(it - cells.begin()));
    }
  }
  return covered;
}

}  // namespace contactcheck
