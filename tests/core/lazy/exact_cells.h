// What bounds made from lattice nodes are exactly, in a body's frame: for judging what kernels
// compute.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/lazy/lattice_tree.h"
#include "core/lazy/lazy_state.h"
#include "tests/support/wide.h"

namespace contactcheck::test {

struct WideRange {
  Wide lo, hi;
  void join(const WideRange& other) { lo = std::min(lo, other.lo), hi = std::max(hi, other.hi); }
};

/// A coordinate, in the body's frame, as a function of y = 2 x - 1: the sum of term[i] times the
/// product of y_k over the bits k of i.
class ExactCell {
 public:
  ExactCell(const LazyState& state, std::uint32_t cell, int axis) {
    const CornerIds& ids = state.shape->lattice->cell_nodes[cell];
    for (unsigned i = 0; i < 8; ++i)
      for (unsigned c = 0; c < 8; ++c) {
        const Wide node = in_frame(state, ids[c], axis) / 8;
        term_[i] += std::popcount(i & ~c) % 2 == 0 ? node : -node;
      }
  }
  Wide at(const Vec3& local) const {
    Wide sum = 0;
    for (unsigned i = 0; i < 8; ++i) {
      Wide part = term_[i];
      for (int k = 0; k < 3; ++k)
        if (i >> k & 1) part *= 2 * Wide(local[k]) - 1;
      sum += part;
    }
    return sum;
  }
  /// What lattice_tree.h says of a box, over one piece.
  WideRange over(const PieceLanes& pieces, std::size_t lane) const {
    Wide middle[3], half[3];
    for (int k = 0; k < 3; ++k) {
      const Wide lo = pieces.lo[k][lane], hi = pieces.hi[k][lane];
      middle[k] = (lo + hi) / (2 * PieceLanes::kSteps);
      half[k] = (hi - lo) / (2 * PieceLanes::kSteps);
    }
    Wide value = 0, wide = 0;
    for (unsigned of = 0; of < 8; ++of) {  // the derivative along the bits of `of`
      Wide derivative = 0, steps = 1;
      for (unsigned i = 0; i < 8; ++i) {
        if ((i & of) != of) continue;
        Wide part = term_[i];
        for (int k = 0; k < 3; ++k)
          if ((i & ~of) >> k & 1) part *= middle[k];
        derivative += part;
      }
      for (int k = 0; k < 3; ++k)
        if (of >> k & 1) steps *= half[k];
      (of == 0 ? value : wide) += of == 0 ? derivative : magnitude(derivative) * steps;
    }
    return {value - wide, value + wide};
  }

 private:
  static Wide in_frame(const LazyState& state, std::uint32_t node, int axis) {
    if (state.precision == Precision::kSingle) return state.single.nodes[node][axis];
    return (Wide(state.nodes[node][axis]) - state.origin[axis]) * state.scale;
  }
  Wide term_[8] = {};
};

/// What lattice_tree.h says of the box of a child: over all of its pieces.
inline WideRange exact_range(const LazyState& state, std::uint32_t block, std::uint32_t child,
                             int axis) {
  const LatticeTree& tree = *state.tree;
  WideRange out = {1e300, -1e300};
  for (std::uint32_t p = tree.blocks[block].begin; p < tree.blocks[block].end; ++p)
    for (std::size_t lane = 0; lane < kBlockWidth; ++lane)
      if (tree.pieces[p].child[lane] == child)
        out.join(ExactCell(state, tree.pieces[p].cell[lane], axis).over(tree.pieces[p], lane));
  return out;
}

}  // namespace contactcheck::test
