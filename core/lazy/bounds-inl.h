// Bounds of the eight children of a block, from deformed lattice nodes. Compiled once per
// instruction set (kernels.cpp).
//
// Why the slacks suffice. Exact bounds hold the exact images of the vertices (lattice_tree.h). The
// following is how far computed bounds differ from exact ones, and mapped vertices from exact
// images.
//
// Notation:
//   * u = 2^-24. A float operation with a result of at most v rounds by at most u v. Errors are
//     counted to first order in u.
//   * M: LazyState::reach, not below any |coordinate| of the body's nodes in its frame. All values
//     of a trilinear function of the nodes lie within M. So do its terms and derivatives, which are
//     means of nodes with signs.
//
// Claims:
//   * A box is wrong by at most 202 u M. Its slack is 256 u M (LazyState::slack).
//   * A slab is wrong by at most 955 u M and a test of two slabs in one frame (meeting-inl.h) by
//     296 u M. The slack of a slab is 2048 u M (LazyState::slab_slack).
//   * What is no multiple of u M is added to both slacks.
//
// Assumption: middles y and half-widths e of pieces are exact, |y| <= 1 and e <= 1. (Quantisation
// lets e reach 1 + 2^-14. That changes no error below by more than a thousandth.)
//
// Box:
//   * A node as a float is wrong by u M. (The rounding of x - origin in double comes last, below.)
//   * A term of a cell (CellTerms) is a sum of eight eighths of nodes with signs. The nodes add
//     u M. Its sums of 2, 4 and 8 eighths are at most M/4, M/2 and M. There are 4, 2 and 1 of them,
//     so each of the three levels adds u M. In all 4 u M.
//   * A blend a + y b has the errors of a and of b, u M for the product (none where it is fused)
//     and u M for the sum.
//   * A mixed derivative is a blend of two terms: 4 + 4 + 2 = 10 u M. f_stu is a term: 4 u M.
//   * A slope is a blend of two such blends: 10 + 10 + 2 = 22 u M.
//   * The value is a blend of a slope and of a blend like it: 22 + 22 + 2 = 46 u M.
//   * The half-range is the sum of the following. Each product with a half-width, and of two
//     half-widths, adds u M:
//       3 slopes times e:                3 (22 + 1) = 69 u M
//       3 mixed derivatives times e e':  3 (10 + 2) = 36 u M
//       f_stu times e e' e'':               (4 + 3) =  7 u M
//   * Value and half-range: 46 + 69 + 36 + 7 = 158 u M.
//   * The sums of the half-range have up to 7 terms of at most M: below 28 u M.
//   * The difference of value and half-range is at most 8 M and rounds once, the push outward by
//     the slack once more: 16 u M.
//   * In all 158 + 28 + 16 = 202 u M.
//
// Slab, along a direction n. Bounds are right for every n. It has length 1, or 0, up to rounding:
//   * n . X is a sum of three products of at most M, by two sums of at most 3 M, taken as five
//     roundings of 3 M. So the errors of X come three times, and 15 u M:
//       value             3 * 46 + 15 = 153 u M
//       slope             3 * 22 + 15 =  81 u M
//       mixed derivative  3 * 10 + 15 =  45 u M
//       f_stu             3 *  4 + 15 =  27 u M
//   * Let g be the three slopes, each at most 3 M, so |g| <= sqrt(27) M. Let k = g.m / m.m
//     (lattice_tree.h). Every k is right, so the error of k itself costs nothing. k m is the
//     projection of g onto m: |k| <= |g| / |m|, and k m and g - k m have lengths of at most |g|.
//     Their three |components| sum to at most sqrt(3) |g| = 9 M.
//   * The half-range across m:
//       3 components of g - k m times e: 3 * 81, and for k m, for the difference and for the
//         product with e each 9 over the three axes: 270 u M
//       3 mixed derivatives times e e':  3 (45 + 3 + 3) = 153 u M
//       f_stu times e e' e'':               27 + 3 * 3  =  36 u M
//   * Its sums are at most 6, 9, 12, 21, 21 and 21 M: 90 u M.
//   * The part along m is k times the difference of a slab's end and m.c, c the middle:
//       m.c:         three products and two sums, at most sqrt(3) |m| each: 5.2 u |m|
//       difference:  at most |m| times the diagonal sqrt(12) of the cell: 3.5 u |m|
//       times k:     8.7 u |m| * sqrt(27) M / |m| = 46 u M
//       the product: at most sqrt(27) sqrt(12) M = 18 M: 18 u M
//     Ends of slabs are stored as floats outside of the vertices (lattice_tree.cpp).
//   * Value and part along m sum to at most 21 M, with the half-range to 42 M: 63 u M.
//   * So the two ends are wrong by 153 + 270 + 153 + 36 + 90 + 46 + 18 + 63 = 829 u M.
//   * Middle, half-width and its sum with the slack (store_slab) round values of at most 42 M:
//     126 u M.
//   * In all 829 + 126 = 955 u M.
//
// Test of two slabs in one frame (not_separated(), with its names). Let a = n.m as computed, any
// number of at most 1 up to rounding. |n - a m| <= 1, so its |components| sum to at most sqrt(3). A
// slab's |middle| + half is at most 42 M, a box's |coordinates| 8 M:
//   * n - a m rounds twice per axis, times a coordinate of at most M: 2 sqrt(3) u M, below 4 u M.
//   * Middle and half-width of the box round once per axis: sqrt(3) * 8 u M, below 14 u M. Their
//     products with n - a m: another 14 u M.
//   * a times middle and half of the slab: 42 u M.
//   * |theirs| + their_half is at most sqrt(42^2 + (8 sqrt(3))^2) M < 45 M. Three sums: 135 u M.
//   * The comparison has values of at most 42 + 45 = 87 M: 87 u M.
//   * In all 4 + 14 + 14 + 42 + 135 + 87 = 296 u M; with the slab's own 955 u M below 2048 u M.
//
// Added to both slacks, in units of the world times the scale (place_one() in lazy_state.cpp):
//   * the error of the canonical mapping (mapping.h);
//   * the rounding of x - origin, 2^-53 of |x| and of |origin|, four times;
//   * 1e-37 for float underflow.
// They are errors per coordinate. Along n, of length 1, they come at most sqrt(3) times: slabs get
// them twice.
//
// Single precision (lazy_state.h). The float nodes are the nodes. All of the above holds, with the
// first u M to spare:
//   * Bounded are vertices that are mapped from these nodes in floats. Pieces were made for exact
//     local coordinates. The mapped vertices differ from the exact images of those by 10 u M in
//     blends (mapping_error_bound() of floats) and by 3 u M as three local coordinates are rounded
//     (place_in_single() in lazy_state.cpp). That makes 13 u M, and below 26 u M along n.
//   * These are added to 256 u M and 2048 u M, though the first would hold them: 202 + 13.
//   * M is the scene's half-width, the same for all bodies.
//   * Boxes of triangles and of refitted bodies are made of the very floats that are tested. They
//     need no slack.
//   * So all triangles are tested whose boxes overlap, except those that slabs separate. Those
//     share no point. What is found is what intersects, as in doubles.

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

// Bounds of eight children, over the pieces joined so far.
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

// The direction of each lane's child.
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

// Bounds of the first pieces of the children, lane by lane, and their directions.
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

// Joins the bounds of eight more pieces to those of their children.
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
  // No slab where there is no child, nor where bounds overflowed.
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

// Moves bounds outward by the slacks; lanes without a child become empty.
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

// The bounds of a block's children in this frame, computed when first asked for.
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
