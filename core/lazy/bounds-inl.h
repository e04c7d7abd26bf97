// Bounds of the eight children of a block, from deformed lattice nodes. Compiled once per
// instruction set (kernels.cpp).
//
// Slack. Let u = 2^-24 and M the largest |coordinate| of the body's nodes in its frame, where all
// values of a hull lie. A node's float is wrong by u M (and by the rounding of x - origin in
// double, below). In an expansion, differences of nodes are at most 2 M and wrong by 4 u M, and a
// blend b + s (c - b) adds 2 u M for the difference, 2 u M for the product (none where it is fused)
// and u M for the sum. So, each times its half-widths of at most 1/2: the value is wrong by 16 u M,
// the three slopes (at most 2 M, wrong by 14 u M) by 21 u M, three second derivatives (4 M, wrong
// by 18 u M) by 14 u M, the third (8 M, wrong by 20 u M) by 3 u M; products and sums of them, at
// most 4 M, add 7 roundings of u 4 M: 82 u M in all. A hull's edges are wrong by 4 u M, their
// products with reaches by 2 u M more, and it adds three sums of values up to 7 M: 39 u M. Pushing
// a box outward rounds once more, at 8 M. Below 95 u M, to first order; 128 u M is the slack.
// Slabs: n has components of at most 1, so sums over the axes are at most three times as large and
// as wrong, and m.c of up to 381 comes in times a slope of up to 8 M / 127: below 500 u M. The test
// of two slabs in one frame (traverse-inl.h) sums about 20 products of values up to 9 M with
// factors of at most 2: below 800 u M. 2048 u M is the slack of slabs. To both come, in units of
// the world, the error of the canonical mapping (mapping.h), that of x - origin (2^-53 of the
// largest coordinate) and float underflow.

#if defined(CONTACTCHECK_LAZY_BOUNDS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_BOUNDS_INL
#undef CONTACTCHECK_LAZY_BOUNDS_INL
#else
#define CONTACTCHECK_LAZY_BOUNDS_INL
#endif

#include <hwy/highway.h>

#include "core/lazy/hulls-inl.h"
#include "core/lazy/lazy_state.h"
#include "core/lazy/pieces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Without slabs.
HWY_INLINE void no_slabs(LaneSlabs& out) {
  for (std::size_t c = 0; c < kBlockWidth; ++c) {
    out.normal[0][c] = out.normal[1][c] = out.normal[2][c] = out.middle[c] = 0.0f;
    out.half[c] = kNoSlab;
  }
}

// The bounds of a block's children in this frame.
HWY_INLINE const BlockBounds& bounds(LazyState& state, std::uint32_t index, FrameArena& arena) {
  if (const BlockBounds* known = state.blocks.find(index)) return *known;
  auto& out = *static_cast<BlockBounds*>(arena.take(sizeof(BlockBounds)));
  const TreeBlock& block = state.tree->blocks[index];
  if (block.hull) {
    bound_hulls(state, block, out.box);
    no_slabs(out.slab);
  } else {
    bound_pieces(state, block, out);
  }
  state.blocks.put(index, &out);
  return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
