// Bounds of the eight children of a block, from deformed lattice nodes. Compiled once per
// instruction set (kernels.cpp).
//
// Slack. Let u = 2^-24 and M the largest |coordinate| of the body's nodes in its own frame, where
// all values of a hull lie. A node's float is wrong by u M (and by the rounding of x - origin in
// double, below). A blend b + s (c - b) of two values wrong by e each adds 2 u M for the
// difference, 2 u M for the product (none where it is fused) and u M for the sum: 5 u M. Three
// nested blends: 16 u M in all. An edge is wrong by 2 u M for its nodes and 2 u M for the
// difference, its product with the reach by another 2 u M; three axes: 18 u M, and three sums of
// values up to 7 M: 21 u M. Pushing a box outward rounds once more, at 8 M. Below 50 u M in all,
// to first order; 64 u M is the slack. Slabs: n has components of at most 1, n . node is at most
// 2 M and wrong by 6 u M; the expansion adds differences of up to 16 M in about 20 roundings, times
// half-widths of at most 1/2 each, and m.c of up to 381 times a slope of up to 8 M / 127: below
// 1000 u M in all. The test of two slabs in one frame (traverse-inl.h) sums about 20 products of
// values up to 9 M with factors of at most 2: below 800 u M. 2048 u M is the slack of slabs. To
// both come, in units of the world, the error of the canonical mapping (mapping.h), that of x -
// origin (2^-53 of the largest coordinate) and float underflow.

#if defined(CONTACTCHECK_LAZY_BOUNDS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_BOUNDS_INL
#undef CONTACTCHECK_LAZY_BOUNDS_INL
#else
#define CONTACTCHECK_LAZY_BOUNDS_INL
#endif

#include <hwy/highway.h>

#include <limits>

#include "core/lazy/lazy_state.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatLanes = hn::CappedTag<float, kBlockWidth>;
using FloatVec = hn::Vec<FloatLanes>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Running bounds of some lanes.
struct Range {
  FloatVec lo, hi;
};

HWY_INLINE void include(Range& range, FloatVec x) {
  range.lo = hn::Min(range.lo, x);
  range.hi = hn::Max(range.hi, x);
}

// Local coordinates of the children in one home cell: exact, quantised values are floats.
HWY_INLINE FloatVec local_of(const std::array<std::uint16_t, kBlockWidth>& steps,
                             std::size_t first) {
  const FloatLanes d;
  const hn::Rebind<std::uint16_t, FloatLanes> d16;
  const hn::Rebind<std::int32_t, FloatLanes> d32;
  const auto wide = hn::PromoteTo(d32, hn::LoadU(d16, steps.data() + first));
  return hn::Mul(hn::ConvertTo(d, wide), hn::Set(d, static_cast<float>(1 / HomePieces::kSteps)));
}

struct BoxLanes {
  FloatVec lo[3], hi[3];
};

// One coordinate of the images of the eight corners of each lane's box. `corner`: that coordinate
// of the cell's nodes.
HWY_INLINE Range image_range(const float (&corner)[8], const BoxLanes& box) {
  const FloatLanes d;
  Range range{hn::Set(d, kInfinity), hn::Set(d, -kInfinity)};
  FloatVec along_s[2][4];  // at the low and high end of s, per edge
  for (int edge = 0; edge < 4; ++edge) {
    const auto from = hn::Set(d, corner[2 * edge]);
    const auto way = hn::Set(d, corner[2 * edge + 1] - corner[2 * edge]);
    along_s[0][edge] = hn::MulAdd(box.lo[0], way, from);
    along_s[1][edge] = hn::MulAdd(box.hi[0], way, from);
  }
  for (const auto& edge : along_s) {
    const auto near_way = hn::Sub(edge[1], edge[0]), far_way = hn::Sub(edge[3], edge[2]);
    for (const auto& t : {box.lo[1], box.hi[1]}) {
      const auto near = hn::MulAdd(t, near_way, edge[0]);
      const auto way = hn::Sub(hn::MulAdd(t, far_way, edge[2]), near);
      include(range, hn::MulAdd(box.lo[2], way, near));
      include(range, hn::MulAdd(box.hi[2], way, near));
    }
  }
  return range;
}

struct CellCorners {
  float axis[3][8];
};

HWY_INLINE CellCorners corners_in_frame(const LazyState& state, std::uint32_t cell) {
  CellCorners out;
  const CornerIds& ids = state.shape->lattice->cell_nodes[cell];
  for (int c = 0; c < 8; ++c)
    for (int k = 0; k < 3; ++k) out.axis[k][c] = state.near_nodes[ids[c]].v[k];
  return out;
}

// Half-widths and middle of each lane's piece: exact.
struct PieceLanes {
  FloatVec middle[3], half[3];
};

HWY_INLINE PieceLanes piece_lanes(const BoxLanes& box) {
  const FloatLanes d;
  const auto half = hn::Set(d, 0.5f);
  PieceLanes out;
  for (int k = 0; k < 3; ++k) {
    out.middle[k] = hn::Mul(half, hn::Add(box.lo[k], box.hi[k]));
    out.half[k] = hn::Mul(half, hn::Sub(box.hi[k], box.lo[k]));
  }
  return out;
}

// A trilinear function about a point: value, gradient, mixed derivatives.
struct Expansion {
  FloatVec value, s, t, u, st, su, tu, stu;
};

HWY_INLINE Expansion expand(const FloatVec (&corner)[8], const FloatVec (&at)[3]) {
  FloatVec along_s[4], edge[4];
  for (int j = 0; j < 4; ++j) {
    edge[j] = hn::Sub(corner[2 * j + 1], corner[2 * j]);
    along_s[j] = hn::MulAdd(at[0], edge[j], corner[2 * j]);
  }
  const auto near_t = hn::Sub(along_s[1], along_s[0]), far_t = hn::Sub(along_s[3], along_s[2]);
  const auto near_st = hn::Sub(edge[1], edge[0]), far_st = hn::Sub(edge[3], edge[2]);
  const auto near = hn::MulAdd(at[1], near_t, along_s[0]);
  const auto near_s = hn::MulAdd(at[1], near_st, edge[0]);
  Expansion out;
  out.u = hn::Sub(hn::MulAdd(at[1], far_t, along_s[2]), near);
  out.su = hn::Sub(hn::MulAdd(at[1], far_st, edge[2]), near_s);
  out.tu = hn::Sub(far_t, near_t);
  out.stu = hn::Sub(far_st, near_st);
  out.value = hn::MulAdd(at[2], out.u, near);
  out.s = hn::MulAdd(at[2], out.su, near_s);
  out.t = hn::MulAdd(at[2], out.tu, near_t);
  out.st = hn::MulAdd(at[2], out.stu, near_st);
  return out;
}

struct SlabDirection {
  FloatVec world[3];        // n, about a unit vector, or 0
  FloatVec local[3];        // m
  FloatVec inverse_square;  // 1 / m.m
};

HWY_INLINE FloatVec signed_steps(const std::array<std::int8_t, kBlockWidth>& steps,
                                 std::size_t first) {
  const FloatLanes d;
  const hn::Rebind<std::int8_t, FloatLanes> d8;
  const hn::Rebind<std::int32_t, FloatLanes> d32;
  return hn::ConvertTo(d, hn::PromoteTo(d32, hn::LoadU(d8, steps.data() + first)));
}

// n: the image of the surface's normal, by the cofactors of the Jacobian in the middle of each
// child. Whatever it is, bounds along it are right; this one makes them tight.
HWY_INLINE SlabDirection slab_direction(const LazyState& state, const BlockSlabs& slabs,
                                        std::size_t first) {
  const FloatLanes d;
  SlabDirection out;
  FloatVec at[3], s[3], t[3], u[3];
  for (int k = 0; k < 3; ++k) {
    out.local[k] = signed_steps(slabs.normal[k], first);
    at[k] = local_of(slabs.middle[k], first);
  }
  const CellCorners corners = corners_in_frame(state, slabs.cell);
  for (int k = 0; k < 3; ++k) {
    FloatVec corner[8];
    for (int c = 0; c < 8; ++c) corner[c] = hn::Set(d, corners.axis[k][c]);
    const Expansion image = expand(corner, at);
    s[k] = image.s, t[k] = image.t, u[k] = image.u;
  }
  auto square = hn::Zero(d), length2 = hn::Zero(d);
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const auto tu = hn::Sub(hn::Mul(t[i], u[j]), hn::Mul(t[j], u[i]));
    const auto us = hn::Sub(hn::Mul(u[i], s[j]), hn::Mul(u[j], s[i]));
    const auto st = hn::Sub(hn::Mul(s[i], t[j]), hn::Mul(s[j], t[i]));
    out.world[k] =
        hn::MulAdd(out.local[0], tu, hn::MulAdd(out.local[1], us, hn::Mul(out.local[2], st)));
    length2 = hn::MulAdd(out.world[k], out.world[k], length2);
    square = hn::MulAdd(out.local[k], out.local[k], square);
  }
  // Flat cells have no normal; 1e-30 keeps the root from denormals.
  const auto proper = hn::Gt(length2, hn::Set(d, 1e-30f));
  const auto scale = hn::IfThenElseZero(proper, hn::Div(hn::Set(d, 1.0f), hn::Sqrt(length2)));
  for (int k = 0; k < 3; ++k) out.world[k] = hn::Mul(out.world[k], scale);
  out.inverse_square = hn::Div(hn::Set(d, 1.0f), square);
  return out;
}

// n . X over the vertices of each lane in one home cell; derivation in lattice_tree.h.
HWY_INLINE Range slab_range(const CellCorners& cell, const HomePieces& home, const BoxLanes& box,
                            const SlabDirection& n, std::size_t first) {
  const FloatLanes d;
  FloatVec corner[8];
  for (int c = 0; c < 8; ++c)
    corner[c] = hn::MulAdd(n.world[0], hn::Set(d, cell.axis[0][c]),
                           hn::MulAdd(n.world[1], hn::Set(d, cell.axis[1][c]),
                                      hn::Mul(n.world[2], hn::Set(d, cell.axis[2][c]))));
  const PieceLanes piece = piece_lanes(box);
  const Expansion f = expand(corner, piece.middle);
  const FloatVec gradient[3] = {f.s, f.t, f.u};
  auto along = hn::Zero(d), middle = hn::Zero(d);
  for (int k = 0; k < 3; ++k) {
    along = hn::MulAdd(gradient[k], n.local[k], along);
    middle = hn::MulAdd(piece.middle[k], n.local[k], middle);
  }
  along = hn::Mul(along, n.inverse_square);
  const auto& e = piece.half;
  const auto st = hn::Mul(e[0], e[1]);
  auto wide = hn::Mul(hn::Abs(f.st), st);
  wide = hn::MulAdd(hn::Abs(f.su), hn::Mul(e[0], e[2]), wide);
  wide = hn::MulAdd(hn::Abs(f.tu), hn::Mul(e[1], e[2]), wide);
  wide = hn::MulAdd(hn::Abs(f.stu), hn::Mul(st, e[2]), wide);
  for (int k = 0; k < 3; ++k)
    wide = hn::MulAdd(hn::Abs(hn::NegMulAdd(along, n.local[k], gradient[k])), e[k], wide);
  const auto one = hn::Mul(along, hn::Sub(hn::LoadU(d, home.slab_lo.data() + first), middle));
  const auto other = hn::Mul(along, hn::Sub(hn::LoadU(d, home.slab_hi.data() + first), middle));
  return {hn::Sub(hn::Add(f.value, hn::Min(one, other)), wide),
          hn::Add(hn::Add(f.value, hn::Max(one, other)), wide)};
}

HWY_INLINE void join(Range& total, const Range& range, hn::Mask<FloatLanes> present) {
  const auto none = hn::Set(FloatLanes(), kInfinity);
  total.lo = hn::Min(total.lo, hn::IfThenElse(present, range.lo, none));
  total.hi = hn::Max(total.hi, hn::IfThenElse(present, range.hi, hn::Neg(none)));
}

HWY_INLINE void store_slabs(const Range& range, const SlabDirection& n, float slack,
                            std::size_t first, LaneSlabs& out) {
  const FloatLanes d;
  const auto half = hn::Set(d, 0.5f), wide = hn::Set(d, slack);
  // Not where there is no child, nor where bounds overflowed.
  const auto sound =
      hn::And(hn::Le(range.lo, range.hi), hn::Lt(hn::Sub(range.hi, range.lo), hn::Set(d, kNoSlab)));
  const auto middle = hn::Mul(half, hn::Add(range.lo, range.hi));
  const auto reach = hn::MulAdd(half, hn::Sub(range.hi, range.lo), wide);
  for (int k = 0; k < 3; ++k)
    hn::Store(hn::IfThenElseZero(sound, n.world[k]), d, out.normal[k] + first);
  hn::Store(hn::IfThenElseZero(sound, middle), d, out.middle + first);
  hn::Store(hn::IfThenElse(sound, reach, hn::Set(d, kNoSlab)), d, out.half + first);
}

HWY_INLINE void bound_pieces(const LazyState& state, const TreeBlock& block,
                             const BlockBounds& out) {
  const FloatLanes d;
  const auto slack = hn::Set(d, state.slack);
  const Range nothing{hn::Set(d, kInfinity), hn::Set(d, -kInfinity)};
  for (std::size_t first = 0; first < kBlockWidth; first += hn::Lanes(d)) {
    const SlabDirection n = slab_direction(state, state.tree->slabs[block.slabs], first);
    Range total[3] = {nothing, nothing, nothing}, slab = nothing;
    for (std::uint32_t p = block.begin; p < block.end; ++p) {
      const HomePieces& home = state.tree->pieces[p];
      const auto bits = static_cast<std::uint8_t>(home.children >> first);
      if (bits == 0) continue;
      const auto present = hn::LoadMaskBits(d, &bits);
      const CellCorners corners = corners_in_frame(state, home.cell);
      BoxLanes box;
      for (int k = 0; k < 3; ++k) {
        box.lo[k] = local_of(home.lo[k], first);
        box.hi[k] = local_of(home.hi[k], first);
      }
      for (int k = 0; k < 3; ++k) join(total[k], image_range(corners.axis[k], box), present);
      join(slab, slab_range(corners, home, box, n, first), present);
    }
    for (int k = 0; k < 3; ++k) {
      hn::Store(hn::Sub(total[k].lo, slack), d, out.box->lo[k] + first);
      hn::Store(hn::Add(total[k].hi, slack), d, out.box->hi[k] + first);
    }
    store_slabs(slab, n, state.slab_slack, first, *out.slab);
  }
}

// A point as four floats, however many fit a vector.
using PointLanes = hn::CappedTag<float, 4>;
constexpr std::size_t kPointParts = 4 / hn::MaxLanes(PointLanes());

struct Point {
  hn::Vec<PointLanes> part[kPointParts];
};

template <class Operation>
HWY_INLINE Point per_part(const Point& a, const Point& b, Operation&& operation) {
  Point out;
  for (std::size_t i = 0; i < kPointParts; ++i) out.part[i] = operation(a.part[i], b.part[i]);
  return out;
}

HWY_INLINE Point least_of(const Point& a, const Point& b) {
  return per_part(a, b, [](auto x, auto y) HWY_ATTR { return hn::Min(x, y); });
}
HWY_INLINE Point most_of(const Point& a, const Point& b) {
  return per_part(a, b, [](auto x, auto y) HWY_ATTR { return hn::Max(x, y); });
}
HWY_INLINE Point sum_of(const Point& a, const Point& b) {
  return per_part(a, b, [](auto x, auto y) HWY_ATTR { return hn::Add(x, y); });
}
HWY_INLINE Point difference_of(const Point& a, const Point& b) {
  return per_part(a, b, [](auto x, auto y) HWY_ATTR { return hn::Sub(x, y); });
}
HWY_INLINE Point product_of(const Point& a, const Point& b) {
  return per_part(a, b, [](auto x, auto y) HWY_ATTR { return hn::Mul(x, y); });
}
HWY_INLINE Point all_equal(float value) {
  Point out;
  for (auto& part : out.part) part = hn::Set(PointLanes(), value);
  return out;
}
HWY_INLINE Point load_point(const float* from) {
  Point out;
  for (std::size_t i = 0; i < kPointParts; ++i)
    out.part[i] = hn::Load(PointLanes(), from + i * hn::MaxLanes(PointLanes()));
  return out;
}
HWY_INLINE void store_point(const Point& p, float* to) {
  for (std::size_t i = 0; i < kPointParts; ++i)
    hn::Store(p.part[i], PointLanes(), to + i * hn::MaxLanes(PointLanes()));
}

HWY_INLINE Point node(const LazyState& state, std::uint32_t id) {
  return load_point(state.near_nodes[id].v);
}

struct PointRange {
  Point lo, hi;
};

HWY_INLINE PointRange no_points() { return {all_equal(kInfinity), all_equal(-kInfinity)}; }

HWY_INLINE void include(PointRange& range, const Point& p) {
  range.lo = least_of(range.lo, p);
  range.hi = most_of(range.hi, p);
}

HWY_INLINE PointRange bound_hull(const LazyState& state, const HullChild& hull) {
  PointRange all = no_points();
  for (std::uint32_t n = hull.node_begin; n < hull.node_end; ++n)
    include(all, node(state, state.tree->hull_nodes[n]));
  Point wide = all_equal(state.slack);
  for (int k = 0; k < 3; ++k)
    wide = sum_of(wide, product_of(all_equal(hull.reach[k]), load_point(state.longest_edge[k].v)));
  all.lo = difference_of(all.lo, wide);
  all.hi = sum_of(all.hi, wide);
  return all;
}

HWY_INLINE void bound_hulls(const LazyState& state, const TreeBlock& block, LaneBoxes& out) {
  for (std::uint32_t c = 0; c < kBlockWidth; ++c) {
    PointRange range = no_points();
    if (c < block.children) range = bound_hull(state, state.tree->hulls[block.begin + c]);
    HWY_ALIGN float ends[2][4];
    store_point(range.lo, ends[0]);
    store_point(range.hi, ends[1]);
    for (int k = 0; k < 3; ++k) {
      out.lo[k][c] = ends[0][k];
      out.hi[k][c] = ends[1][k];
    }
  }
}

// Without slabs.
HWY_INLINE void no_slabs(LaneSlabs& out) {
  for (std::size_t c = 0; c < kBlockWidth; ++c) {
    out.normal[0][c] = out.normal[1][c] = out.normal[2][c] = out.middle[c] = 0.0f;
    out.half[c] = kNoSlab;
  }
}

// The bounds of a block's children in this frame.
HWY_INLINE const BlockBounds& bounds(LazyState& state, std::uint32_t index,
                                     LazyCounters& counters) {
  BlockBounds& out = state.block_bounds[index];
  if (state.block_frame[index] == state.frame) return out;
  struct Room {
    LaneBoxes box;
    LaneSlabs slab;
  };
  auto* const room = static_cast<Room*>(state.arena.take(sizeof(Room)));
  out = {&room->box, &room->slab};
  const TreeBlock& block = state.tree->blocks[index];
  if (block.hull) {
    bound_hulls(state, block, *out.box);
    no_slabs(*out.slab);
  } else {
    bound_pieces(state, block, out);
  }
  state.block_frame[index] = state.frame;
  ++counters.blocks_bounded;
  return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
