// Bounds of the eight children of a block, from deformed lattice nodes. Compiled once per
// instruction set (kernels.cpp).
//
// Slack. Let u = 2^-24 and M the largest |coordinate| of the body's nodes in its frame, where all
// values of a trilinear function of them lie. A node's float is wrong by u M (and by the rounding
// of x - origin in double, below). Terms of a cell (lazy_state.h) are means of eight such with
// signs, at most M, and their three sums add u M each: wrong by 4 u M. A blend a + y b adds the
// error of b, u M for the product (none where it is fused) and u M for the sum. So the mixed
// derivatives are wrong by 10 u M, the slopes by 22 u M, the value by 46 u M. Each comes in times
// half-widths of at most 1: 46 + 3 (22 + 1) + 3 (10 + 2) + 6 = 157 u M; the sums, of up to 7 terms,
// add 28 u M, the difference to the value and the push outward 16 u M: 201 u M, to first order. 256
// u M is the slack. Half-widths reach 1 + 2^-14 by quantisation: nothing, beside this. Slabs: n has
// components of at most 1, so values along it and their errors are at most three times as large,
// and three products and two sums of at most 3 M come in for each: 153, 81 and 45 u M, 153 + 3 (81
// + 12) + 3 (45 + 6) + 20 = 605 u M, sums 84 u M. The part along m is slope (at most 9 M / 127)
// times a difference of up to 762, whose rounding is 1000 u: 100 u M and 60 u M. Below 1000 u M.
// The test of two slabs in one frame (traverse-inl.h) sums about 20 products of values up to 9 M
// with factors of at most 2: below 800 u M. 2048 u M is the slack of slabs. To both come, in units
// of the world, the error of the canonical mapping (mapping.h), that of x - origin (2^-53 of the
// largest coordinate) and float underflow.
//
// In single precision (lazy_state.h) the float nodes are the nodes: all of the above holds, with
// the first u M to spare. But what is bounded are vertices mapped from them in floats. Those are
// off the exact image of their local coordinates, for which the pieces were made, by 10 u M of the
// blends (mapping.h with u for 2^-53) and 3 u M of the rounding of three local coordinates
// (lazy_state.cpp): 13 u M, and along n at most three times that. These come to the slacks of 256
// u M and 2048 u M, though the first would hold them: 201 + 13. M is the scene's half-width, the
// same for all bodies. Boxes of triangles and of refitted bodies are made of the very floats that
// are tested: they need no slack. So all triangles are tested whose boxes meet, but for those that
// slabs part, and those share no point: what is found is what intersects, as in doubles.

#if defined(CONTACTCHECK_LAZY_BOUNDS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_BOUNDS_INL
#undef CONTACTCHECK_LAZY_BOUNDS_INL
#else
#define CONTACTCHECK_LAZY_BOUNDS_INL
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "core/lazy/lazy_state.h"
#include "core/lazy/pieces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Bounds of eight children while their pieces come in.
struct alignas(64) RunningBounds {
  float lo[kBlockWidth][4], hi[kBlockWidth][4];        // box and slab
  float world[kBlockWidth][4], local[kBlockWidth][4];  // of SlabDirection; last of local: inverse
};

HWY_INLINE void store_rows(const FloatVec& x, const FloatVec& y, const FloatVec& z,
                           const FloatVec& w, float (*out)[4]) {
  hn::StoreInterleaved4(x, y, z, w, FloatLanes(), out[0]);
}

HWY_INLINE void store_direction(const SlabDirection& n, std::size_t first, RunningBounds& out) {
  store_rows(n.world[0], n.world[1], n.world[2], hn::Zero(FloatLanes()), out.world + first);
  store_rows(n.local[0], n.local[1], n.local[2], n.inverse_square, out.local + first);
}

// That of each lane's child.
HWY_INLINE SlabDirection load_direction(const RunningBounds& from, const PieceLanes& pieces,
                                        std::size_t first) {
  const auto rows_of = [&](const float(&all)[kBlockWidth][4]) HWY_ATTR {
    return load_rows([&](std::size_t lane) HWY_ATTR { return all[pieces.child[first + lane]]; });
  };
  const Rows world = rows_of(from.world), local = rows_of(from.local);
  SlabDirection out{};
  for (int k = 0; k < 3; ++k) {
    out.world[k] = world.part[k];
    out.local[k] = local.part[k];
  }
  out.inverse_square = local.part[3];
  return out;
}

struct PieceRanges {
  Range axis[3], slab;
};

HWY_INLINE PieceRanges ranges_of(const Expansions& x, const PieceLanes& pieces,
                                 const Middles& middle, const SlabDirection& n, std::size_t first) {
  PieceRanges out{};
  for (int k = 0; k < 3; ++k) out.axis[k] = range_over(x.axis[k], middle.half);
  out.slab = slab_range(along(n, x), pieces, middle, n, first);
  return out;
}

HWY_INLINE void store_ranges(const PieceRanges& ranges, float (*lo)[4], float (*hi)[4]) {
  const Range *axis = ranges.axis, &slab = ranges.slab;
  store_rows(axis[0].lo, axis[1].lo, axis[2].lo, slab.lo, lo);
  store_rows(axis[0].hi, axis[1].hi, axis[2].hi, slab.hi, hi);
}

// The first pieces of the children, lane by lane.
HWY_INLINE PieceRanges begin_block(const LazyState& state, const PieceLanes& pieces,
                                   const BlockSlabs& slabs, std::size_t first, SlabDirection& n) {
  const Middles middle = middles_of(pieces, first);
  const Expansions x = expand(state, pieces, first, middle.at);
  n = slab_direction(x, slabs, first);
  return ranges_of(x, pieces, middle, n, first);
}

HWY_INLINE void join_row(const float (&from)[4], float (&to)[4], bool least) {
  for (int k = 0; k < 4; ++k) to[k] = least ? std::min(to[k], from[k]) : std::max(to[k], from[k]);
}

// Eight more pieces, of whichever children.
HWY_NOINLINE void join_pieces(const LazyState& state, const PieceLanes& pieces,
                              RunningBounds& out) {
  const FloatLanes d;
  HWY_ALIGN float lo[kBlockWidth][4], hi[kBlockWidth][4];
  for (std::size_t first = 0; first < kBlockWidth; first += hn::Lanes(d)) {
    const Middles middle = middles_of(pieces, first);
    const Expansions x = expand(state, pieces, first, middle.at);
    const SlabDirection n = load_direction(out, pieces, first);
    store_ranges(ranges_of(x, pieces, middle, n, first), lo + first, hi + first);
  }
  for (std::size_t lane = 0; lane < kBlockWidth; ++lane) {
    join_row(lo[lane], out.lo[pieces.child[lane]], true);
    join_row(hi[lane], out.hi[pieces.child[lane]], false);
  }
}

HWY_INLINE void store_slab(const Range& range, const FloatVec (&normal)[3], float slack,
                           hn::Mask<FloatLanes> present, std::size_t first, LaneSlabs& out) {
  const FloatLanes d;
  const auto half = hn::Set(d, 0.5f), wide = hn::Set(d, slack);
  // Not where there is no child, nor where bounds overflowed.
  const auto sound =
      hn::And(present, hn::And(hn::Le(range.lo, range.hi),
                               hn::Lt(hn::Sub(range.hi, range.lo), hn::Set(d, kNoSlab))));
  const auto middle = hn::Mul(half, hn::Add(range.lo, range.hi));
  const auto reach = hn::MulAdd(half, hn::Sub(range.hi, range.lo), wide);
  for (int k = 0; k < 3; ++k)
    hn::Store(hn::IfThenElseZero(sound, normal[k]), d, out.normal[k] + first);
  hn::Store(hn::IfThenElseZero(sound, middle), d, out.middle + first);
  hn::Store(hn::IfThenElse(sound, reach, hn::Set(d, kNoSlab)), d, out.half + first);
}

HWY_INLINE void store_box(const Range (&range)[3], float slack, hn::Mask<FloatLanes> present,
                          std::size_t first, LaneBoxes& out) {
  const FloatLanes d;
  const auto wide = hn::Set(d, slack), none = hn::Set(d, kInfinity);
  for (int k = 0; k < 3; ++k) {
    hn::Store(hn::IfThenElse(present, hn::Sub(range[k].lo, wide), none), d, out.lo[k] + first);
    hn::Store(hn::IfThenElse(present, hn::Add(range[k].hi, wide), hn::Neg(none)), d,
              out.hi[k] + first);
  }
}

// Moves them outward; lanes without a child become empty.
HWY_INLINE void finish_block(const LazyState& state, const PieceRanges& ranges,
                             const FloatVec (&normal)[3], std::uint32_t children, std::size_t first,
                             BlockBounds& out) {
  const auto present = hn::FirstN(FloatLanes(), children > first ? children - first : 0);
  store_box(ranges.axis, state.slack, present, first, out.box);
  store_slab(ranges.slab, normal, state.slab_slack, present, first, out.slab);
}

HWY_INLINE void finish_block(const LazyState& state, const RunningBounds& from,
                             std::uint32_t children, BlockBounds& out) {
  const auto rows_of = [](const float(*all)[4]) HWY_ATTR {
    return load_rows([all](std::size_t lane) HWY_ATTR { return all[lane]; });
  };
  for (std::size_t first = 0; first < kBlockWidth; first += hn::Lanes(FloatLanes())) {
    const Rows lo = rows_of(from.lo + first), hi = rows_of(from.hi + first);
    const Rows n = rows_of(from.world + first);
    PieceRanges all{};
    for (int k = 0; k < 3; ++k) all.axis[k] = {lo.part[k], hi.part[k]};
    all.slab = {lo.part[3], hi.part[3]};
    const FloatVec normal[3] = {n.part[0], n.part[1], n.part[2]};
    finish_block(state, all, normal, children, first, out);
  }
}

HWY_NOINLINE void bound_block(const LazyState& state, std::uint32_t index, BlockBounds& out) {
  const TreeBlock& block = state.tree->blocks[index];
  const PieceLanes& own = state.tree->pieces[block.begin];
  const bool more = block.end > block.begin + 1;
  RunningBounds running;
  for (std::size_t first = 0; first < kBlockWidth; first += hn::Lanes(FloatLanes())) {
    SlabDirection n{};
    const PieceRanges ranges = begin_block(state, own, state.tree->slabs[index], first, n);
    if (!more) {
      finish_block(state, ranges, n.world, block.children, first, out);
      continue;
    }
    store_direction(n, first, running);
    store_ranges(ranges, running.lo + first, running.hi + first);
  }
  if (!more) return;
  for (std::uint32_t p = block.begin + 1; p < block.end; ++p)
    join_pieces(state, state.tree->pieces[p], running);
  finish_block(state, running, block.children, out);
}

// Of a block's children in this frame.
HWY_INLINE const BlockBounds& bounds(LazyState& state, std::uint32_t index, FrameArena& arena) {
  if (const BlockBounds* known = state.blocks.find(index)) return *known;
  auto& out = *static_cast<BlockBounds*>(arena.take(sizeof(BlockBounds)));
  bound_block(state, index, out);
  state.blocks.put(index, &out);
  return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
