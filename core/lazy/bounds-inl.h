// Bounds of the eight children of a block, from deformed lattice nodes, in a frame or over a step.
// Compiled once per
// instruction set (kernels.cpp).
//
// Why the slacks suffice. Exact bounds contain the exact images of the vertices (lattice_tree.h).
// The following bounds how far computed bounds differ from exact ones, and mapped vertices from
// exact images.
//
// Notation:
//   * u = 2^-24. A float operation with a result of at most v rounds by at most u v. Errors are
//     counted to first order in u.
//   * M: LazyState::reach, not below any |coordinate| of the body's nodes in its frame.
//   * c, e: middle and half-widths of a piece. They are exact, and |c| + e <= 1 along each axis.
//     (Quantisation lets that reach 1 + 2^-14. This changes no error below by a thousandth.)
//   * t_i: the eight terms of a coordinate in a cell (CellTerms). w_i: the product of |c_k| + e_k
//     over the bits k of i, at most 1.
//
// Claims:
//   * A box is wrong by at most 44 u M. Its slack is 64 u M (LazyState::slack).
//   * A slab is wrong by at most 175 u M and a test of two slabs in one frame (meeting-inl.h) by
//     100 u M. The slack of a slab is 384 u M (LazyState::slab_slack).
//   * Errors that are no multiples of u M are added to both slacks.
//
// Two rules:
//   * Rounded sums. If a value is computed by products and sums alone, every number that goes into
//     it meets at most D roundings on its way and S is the value for |numbers|, all added, then it
//     is wrong by at most D u S: each product of numbers is wrong by D u of itself. A fused
//     operation rounds less.
//   * Terms. They are the nodes times a matrix of -1/8 and 1/8 whose rows are orthogonal. So the
//     sum of t_i^2 is the mean of the squared nodes, at most M^2, and the sum of |t_i| at most
//     sqrt(8) M.
//
// Box. Its ends are f(c) -+ the sum of |g_k| e_k, of |f_st| es et (as su, tu) and |f_stu| es et eu:
//   * A node as a float is wrong by u M. The float nodes are taken as the nodes, so their bounds
//     are exact for images that are u M off: u M. (x - origin in double rounds by 2^-53 of itself,
//     so by no more than 2^-53 M: nothing beside u M.)
//   * A term is the result of three levels of sums and differences. Each takes pairs (x, y) to
//     (x + y, x - y). That doubles a sum of squares, the errors' as the values'. So the errors of
//     each level, at most u of its values, are in the end at most u M as a root of the sum of
//     squares, those of all three 3 u M, and the sum of their amounts sqrt(8) * 3 u M: 8.5 u M. An
//     error of t_i comes w_i times.
//   * The rest are rounded sums. S is the sum of |t_i| w_i, at most sqrt(8) M. D is 12:
//       value:             2 roundings (product, sum) in each of f_st, the slope and the value: 6;
//                          the end of the range, the push by the slack: 8
//       |g_k| e_k:         slope 4, product 1, up to 3 sums, end and push 2: 10
//       |f_st| es et:      f_st 2, es et 1, product 1, 3 + 3 sums, end and push 2: 12
//       |f_stu| es et eu:  products 3, 1 + 3 sums, end and push 2: 9
//     12 u sqrt(8) M is below 34 u M. A box's |coordinates| are at most S.
//   * In all 1 + 8.5 + 34 = 43.5 u M.
//
// Slab, along a direction n. Bounds are right for every n. This one has length 1, or 0, up to
// rounding, so its |components| sum to at most sqrt(3):
//   * Nodes and terms of the coordinates: sqrt(3) (1 + 8.5) u M = 16.5 u M.
//   * Terms of n . X have |products| that sum to at most sqrt(3) sqrt(8) M = 4.9 M. The slopes g of
//     n . X: those of a coordinate are at most M each, so |g| <= sqrt(3) sqrt(3) M = 3 M.
//   * Let k = g.m / m.m (lattice_tree.h). Every k is right, so the error of k itself costs nothing.
//     |k| |m| <= |g|, up to rounding. |m| is no less than 1.
//   * Rounded sums of terms. S is 4.9 M. n . X takes 3 roundings (product, two sums), and D is 14:
//       value:             6 + 3, its sum with the part along m, the end: 11
//       |g_k - k m_k| e_k: slope 4 + 3, difference 1, product 1, 3 sums, end: 13
//       |f_st| es et:      2 + 3, es et 1, product 1, 3 + 3 sums, end: 14
//     14 u 4.9 M is below 69 u M.
//   * Rounded sums of |k m_k| e_k. S is at most |k| |m| |e| <= sqrt(3) 3 M = 5.2 M. Product with m,
//     difference, product with e, 3 sums, end: 7 u 5.2 M = 37 u M.
//   * The part along m is k times the difference of a slab's end and m.c. Here m.c is exact: c is a
//     multiple of 2^-15 and m integers, and 127 * 3 * (2^15 + 2) < 2^24. The slab's end is m.y of a
//     vertex of the piece (stored as a float outside of it, lattice_tree.cpp), so the difference is
//     at most |m| |e|, the part at most 5.2 M. Difference, product, two sums: 4 u 5.2 M = 21 u M.
//   * So the ends are wrong by 16.5 + 69 + 37 + 21 = 143.5 u M. They are at most
//     4.9 + 5.2 + 5.2 = 15.3 M.
//   * Middle (one rounding) and half-width (two, with the slack) are together at most the larger
//     |end|: 2 * 15.3 u M, below 31 u M.
//   * In all 143.5 + 31 = 174.5 u M.
//
// Test of two slabs in one frame (not_separated(), with its names). Let a = n.m as computed; for a
// unit n and m, a and |n - a m| are cosine and sine of an angle, up to rounding. W = 15.3 M is the
// largest |middle| + half of a slab, B = sqrt(8) M the largest |coordinate| of a box, x a point of
// both bodies:
//   * n - a m rounds twice, times a coordinate of x, at most M: sqrt(3) (cos + sin) u M, below
//     2.5 u M.
//   * The rounded sums `theirs` and `their_half`: the part of the slab, W cos, meets 4 roundings
//     (product, 3 sums), that of the box, sqrt(3) B sin, another one (lo + hi, hi - lo). So
//     4 * 15.3 cos + 5 * 4.9 sin, below 66 u M.
//   * The comparison rounds W and |theirs| + their_half, at most 15.3 cos + 4.9 sin and so 16.1 M:
//     32 u M.
//   * In all 100.5 u M; with the slab's own 174.5 u M below 384 u M.
//
// Over a step (lazy_state.h): the box and slab of both ends are joined.
//   * Both ends are in frames of one reach, with one slack, so each end's box and slab hold by the
//     above. A box is a least and a largest of floats, and rounds nothing more. (The reach comes of
//     the end's box less the motion and the end's origin of the start's plus the motion: two
//     roundings of the world, by which the reach may be short, that is less than the error of the
//     mapping. It is then far out.)
//   * Along one n the ranges of both ends are joined. That of the start is middle -+ half: their
//     difference and sum, and the middle and half-width of the joined range, round by at most
//     3 * 15.3 u M = 46 u M. With 174.5 and 100.5 u M that makes 321 u M, below 384 u M.
//   * n is the start's. Bounds are right for every n.
//   * Vertices are the doubles at both ends and not images of nodes in between: a vertex moves on
//     the straight line between its rounded ends, which convex bounds of both ends hold.
//
// Added to both slacks, in units of the world times the scale (place_one() in lazy_state.cpp):
//   * the error of the canonical mapping (mapping.h), over a step that of the larger end;
//   * 1e-37 for float underflow.
// They are errors per coordinate. Along n, of length 1, they come at most sqrt(3) times: slabs get
// them twice. (Far out they are no longer small against M, and are rounded with the rest, by some u
// of themselves. They are taken 1.01 times.)
//
// Single precision (lazy_state.h). The float nodes are the nodes. All of the above holds, with the
// first u M to spare:
//   * The bounded vertices are mapped from these nodes in floats. Pieces were made for exact
//     local coordinates. The mapped vertices differ from the exact images of those by 10 u M in
//     blends (mapping_error_bound() of floats) and by 3 u M as three local coordinates are rounded
//     (place_in_single() in lazy_state.cpp). That makes 13 u M, and below 26 u M along n.
//   * These are added to 64 u M and 384 u M.
//   * M is the scene's half-width, the same for all bodies.
//   * Boxes of triangles and of refitted bodies are made from the floats that are tested. They need
//     no slack.
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
  float world[kBlockWidth][4], local[kBlockWidth][4];  // SlabDirection; inverse_square: local[][3]
};

HWY_INLINE void store_rows(const FloatVec& x, const FloatVec& y, const FloatVec& z,
                           const FloatVec& w, float (*out)[4]) {
  hn::StoreInterleaved4(x, y, z, w, FloatLanes(), out[0]);
}

HWY_INLINE void store_direction(const SlabDirection& n, std::size_t first, RunningBounds& out) {
  store_rows(n.world[0], n.world[1], n.world[2], hn::Zero(FloatLanes()), out.world + first);
  store_rows(n.local[0], n.local[1], n.local[2], n.inverse_square, out.local + first);
}

// Loads the slab direction of each lane's child.
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

// Bounds the first piece of each child, one per lane, and computes the children's slab directions.
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
HWY_NOINLINE inline void join_pieces(const LazyState& state, const PieceLanes& pieces,
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

// Joins the bounds of a block's children at the end of a step to those at its start.
HWY_NOINLINE inline void join_end(const LazyState& end, std::uint32_t index, BlockBounds& out) {
  const TreeBlock& block = end.tree->blocks[index];
  const BlockSlabs& slabs = end.tree->slabs[index];
  RunningBounds running;
  for (std::size_t lane = 0; lane < kBlockWidth; ++lane) {
    float square = 0.0f;
    for (int k = 0; k < 3; ++k) {
      const auto m = static_cast<float>(slabs.normal[k][lane]);
      running.world[lane][k] = out.slab.normal[k][lane];
      running.local[lane][k] = m;
      square += m * m;
    }
    running.world[lane][3] = 0.0f;
    running.local[lane][3] = 1.0f / square;
    for (int k = 0; k < 4; ++k) {
      running.lo[lane][k] = kInfinity;
      running.hi[lane][k] = -kInfinity;
    }
  }
  for (std::uint32_t p = block.begin; p < block.end; ++p)
    join_pieces(end, end.tree->pieces[p], running);
  for (std::uint32_t lane = 0; lane < block.children; ++lane) {
    for (int k = 0; k < 3; ++k) {
      out.box.lo[k][lane] = std::min(out.box.lo[k][lane], running.lo[lane][k] - end.slack);
      out.box.hi[k][lane] = std::max(out.box.hi[k][lane], running.hi[lane][k] + end.slack);
    }
    float &middle = out.slab.middle[lane], &half = out.slab.half[lane];
    const float lo = std::min(middle - half, running.lo[lane][3] - end.slab_slack);
    const float hi = std::max(middle + half, running.hi[lane][3] + end.slab_slack);
    // False for bounds that overflowed, too.
    const bool sound = half < kNoSlab && hi - lo < kNoSlab;
    for (int k = 0; k < 3 && !sound; ++k) out.slab.normal[k][lane] = 0.0f;
    middle = sound ? 0.5f * (lo + hi) : 0.0f;
    half = sound ? 0.5f * (hi - lo) : kNoSlab;
  }
}

HWY_NOINLINE inline void bound_block(const LazyState& state, std::uint32_t index,
                                     BlockBounds& out) {
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

// The bounds of a block's children in this frame, computed on first use.
HWY_INLINE const BlockBounds& bounds(LazyState& state, std::uint32_t index, FrameArena& arena) {
  if (const BlockBounds* known = state.blocks.find(index)) return *known;
  auto& out = *static_cast<BlockBounds*>(arena.take(sizeof(BlockBounds)));
  bound_block(state, index, out);
  if (state.end != nullptr) join_end(*state.end, index, out);
  state.blocks.put(index, &out);
  return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
