// Index arithmetic over the full grid of a lattice (kept or not).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/deform/lattice.h"
#include "core/narrow/triangle_box.h"

namespace contactcheck {

class Grid {
 public:
  explicit Grid(const std::array<std::vector<double>, 3>& lines) : lines_(lines) {}

  /// The last interval of `axis` whose lower line is <= x, clamped to the grid. A coordinate on an
  /// inner line belongs to the upper interval: every vertex has one home.
  std::uint32_t interval(int axis, double x) const {
    const std::vector<double>& l = lines_[axis];
    const auto it = std::upper_bound(l.begin() + 1, l.end() - 1, x);
    return static_cast<std::uint32_t>(it - l.begin() - 1);
  }
  GridIndex cell_of(const Vec3& v) const {
    return {interval(0, v.x()), interval(1, v.y()), interval(2, v.z())};
  }

  Aabb cell_box(const GridIndex& c) const {
    Aabb box;
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = lines_[k][c[k]];
      box.hi[k] = lines_[k][c[k] + 1];
    }
    return box;
  }

  /// Calls `visit(GridIndex)` for every cell whose closed box meets the closed triangle, exactly,
  /// in ascending (z, y, x) order, until it returns false. Its time grows with the cells that are
  /// met, not with those of the triangle's box: a needle may lie across a grid of any size.
  template <typename Visit>
  void for_cells_meeting(const TrianglePoints& triangle, Visit&& visit) const {
    Aabb box;
    for (const Vec3& p : triangle) box.extend(p);
    GridIndex lo, hi;
    for (int k = 0; k < 3; ++k) {
      lo[k] = interval(k, box.lo[k]);
      hi[k] = interval(k, box.hi[k]);
      // On a line, the interval below is met too.
      if (lo[k] > 0 && lines_[k][lo[k]] == box.lo[k]) --lo[k];
    }
    visit_part(triangle, lo, hi, visit);
  }

 private:
  /// Visits the cells from `lo` to `hi` that are met; returns false once `visit` has.
  template <typename Visit>
  bool visit_part(const TrianglePoints& triangle, const GridIndex& lo, const GridIndex& hi,
                  Visit& visit) const {
    // Halves z, then y, then x, so that cells are visited in (z, y, x) order.
    const std::size_t axis = lo[2] < hi[2] ? 2 : lo[1] < hi[1] ? 1 : 0;
    if (lo[axis] == hi[axis]) return !triangle_meets_box(triangle, cell_box(lo)) || visit(lo);
    GridIndex last = hi, first = lo;
    last[axis] = lo[axis] + (hi[axis] - lo[axis]) / 2;
    first[axis] = last[axis] + 1;
    return visit_half(triangle, lo, last, visit) && visit_half(triangle, first, hi, visit);
  }
  template <typename Visit>
  bool visit_half(const TrianglePoints& triangle, const GridIndex& lo, const GridIndex& hi,
                  Visit& visit) const {
    Aabb box = cell_box(lo);
    box.extend(cell_box(hi));
    // One cell is tested where it is visited.
    return (lo != hi && !triangle_meets_box(triangle, box)) || visit_part(triangle, lo, hi, visit);
  }

  const std::array<std::vector<double>, 3>& lines_;
};

}  // namespace contactcheck
