// Boxes and slabs of children bounded by pieces: one expansion of the trilinear map per home cell
// (lattice_tree.h has the derivation, bounds-inl.h that of the slacks). Compiled once per
// instruction set (kernels.cpp).

#if defined(CONTACTCHECK_LAZY_PIECES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_PIECES_INL
#undef CONTACTCHECK_LAZY_PIECES_INL
#else
#define CONTACTCHECK_LAZY_PIECES_INL
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

// Local coordinates of the children in one home cell: exact, quantised values are floats.
HWY_INLINE FloatVec local_of(const std::array<std::uint16_t, kBlockWidth>& steps,
                             std::size_t first) {
  const FloatLanes d;
  const hn::Rebind<std::uint16_t, FloatLanes> d16;
  const hn::Rebind<std::int32_t, FloatLanes> d32;
  const auto wide = hn::PromoteTo(d32, hn::LoadU(d16, steps.data() + first));
  return hn::Mul(hn::ConvertTo(d, wide), hn::Set(d, static_cast<float>(1 / HomePieces::kSteps)));
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

// Middle and half-widths of each lane's piece in one home cell: exact.
struct PieceLanes {
  FloatVec middle[3], half[3];
};

HWY_INLINE PieceLanes piece_lanes(const HomePieces& home, std::size_t first) {
  const auto half = hn::Set(FloatLanes(), 0.5f);
  PieceLanes out;
  for (int k = 0; k < 3; ++k) {
    const auto lo = local_of(home.lo[k], first), hi = local_of(home.hi[k], first);
    out.middle[k] = hn::Mul(half, hn::Add(lo, hi));
    out.half[k] = hn::Mul(half, hn::Sub(hi, lo));
  }
  return out;
}

// A trilinear function about a point: value, gradient, mixed derivatives.
struct Expansion {
  FloatVec value, gradient[3], st, su, tu, stu;
};

// `corner`: the function at the cell's nodes.
HWY_INLINE Expansion expand(const float (&corner)[8], const FloatVec (&at)[3]) {
  const FloatLanes d;
  float edge[4];
  FloatVec along_s[4];
  for (int j = 0; j < 4; ++j) {
    edge[j] = corner[2 * j + 1] - corner[2 * j];
    along_s[j] = hn::MulAdd(at[0], hn::Set(d, edge[j]), hn::Set(d, corner[2 * j]));
  }
  const float near_st = edge[1] - edge[0], far_st = edge[3] - edge[2];
  const auto near_t = hn::Sub(along_s[1], along_s[0]), far_t = hn::Sub(along_s[3], along_s[2]);
  const auto near = hn::MulAdd(at[1], near_t, along_s[0]);
  const auto near_s = hn::MulAdd(at[1], hn::Set(d, near_st), hn::Set(d, edge[0]));
  const auto far_s = hn::MulAdd(at[1], hn::Set(d, far_st), hn::Set(d, edge[2]));
  Expansion out;
  out.gradient[2] = hn::Sub(hn::MulAdd(at[1], far_t, along_s[2]), near);
  out.su = hn::Sub(far_s, near_s);
  out.tu = hn::Sub(far_t, near_t);
  out.stu = hn::Set(d, far_st - near_st);
  out.value = hn::MulAdd(at[2], out.gradient[2], near);
  out.gradient[0] = hn::MulAdd(at[2], out.su, near_s);
  out.gradient[1] = hn::MulAdd(at[2], out.tu, near_t);
  out.st = hn::MulAdd(at[2], out.stu, hn::Set(d, near_st));
  return out;
}

// How far the mixed terms take the function from its tangent within the piece.
HWY_INLINE FloatVec curvature(const Expansion& f, const FloatVec (&e)[3]) {
  const auto st = hn::Mul(e[0], e[1]);
  auto wide = hn::Mul(hn::Abs(f.st), st);
  wide = hn::MulAdd(hn::Abs(f.su), hn::Mul(e[0], e[2]), wide);
  wide = hn::MulAdd(hn::Abs(f.tu), hn::Mul(e[1], e[2]), wide);
  return hn::MulAdd(hn::Abs(f.stu), hn::Mul(st, e[2]), wide);
}

HWY_INLINE Range range_over(const Expansion& f, const FloatVec (&e)[3]) {
  auto wide = curvature(f, e);
  for (int k = 0; k < 3; ++k) wide = hn::MulAdd(hn::Abs(f.gradient[k]), e[k], wide);
  return {hn::Sub(f.value, wide), hn::Add(f.value, wide)};
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

// n: the image of the surface's normal, by the cofactors of the Jacobian in the block's first home
// cell. Whatever it is, bounds along it are right; this one makes them tight.
HWY_INLINE SlabDirection slab_direction(const Expansion (&x)[3], const BlockSlabs& slabs,
                                        std::size_t first) {
  const FloatLanes d;
  SlabDirection out;
  for (int k = 0; k < 3; ++k) out.local[k] = signed_steps(slabs.normal[k], first);
  auto square = hn::Zero(d), length2 = hn::Zero(d);
  for (int k = 0; k < 3; ++k) {
    const auto &a = x[(k + 1) % 3].gradient, &b = x[(k + 2) % 3].gradient;
    const auto tu = hn::Sub(hn::Mul(a[1], b[2]), hn::Mul(b[1], a[2]));
    const auto us = hn::Sub(hn::Mul(a[2], b[0]), hn::Mul(b[2], a[0]));
    const auto st = hn::Sub(hn::Mul(a[0], b[1]), hn::Mul(b[0], a[1]));
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

// n . X out of the expansions of the three coordinates.
HWY_INLINE Expansion along(const SlabDirection& n, const Expansion (&x)[3]) {
  const auto sum = [&](auto part) HWY_ATTR {
    return hn::MulAdd(n.world[0], part(x[0]),
                      hn::MulAdd(n.world[1], part(x[1]), hn::Mul(n.world[2], part(x[2]))));
  };
  Expansion out;
  out.value = sum([](const Expansion& e) HWY_ATTR { return e.value; });
  for (int k = 0; k < 3; ++k)
    out.gradient[k] = sum([k](const Expansion& e) HWY_ATTR { return e.gradient[k]; });
  out.st = sum([](const Expansion& e) HWY_ATTR { return e.st; });
  out.su = sum([](const Expansion& e) HWY_ATTR { return e.su; });
  out.tu = sum([](const Expansion& e) HWY_ATTR { return e.tu; });
  out.stu = sum([](const Expansion& e) HWY_ATTR { return e.stu; });
  return out;
}

// n . X over the vertices of each lane in one home cell; derivation in lattice_tree.h.
HWY_INLINE Range slab_range(const Expansion& f, const HomePieces& home, const PieceLanes& piece,
                            const SlabDirection& n, std::size_t first) {
  const FloatLanes d;
  auto slope = hn::Zero(d), middle = hn::Zero(d);
  for (int k = 0; k < 3; ++k) {
    slope = hn::MulAdd(f.gradient[k], n.local[k], slope);
    middle = hn::MulAdd(piece.middle[k], n.local[k], middle);
  }
  slope = hn::Mul(slope, n.inverse_square);
  auto wide = curvature(f, piece.half);
  for (int k = 0; k < 3; ++k)
    wide =
        hn::MulAdd(hn::Abs(hn::NegMulAdd(slope, n.local[k], f.gradient[k])), piece.half[k], wide);
  const auto one = hn::Mul(slope, hn::Sub(hn::LoadU(d, home.slab_lo.data() + first), middle));
  const auto other = hn::Mul(slope, hn::Sub(hn::LoadU(d, home.slab_hi.data() + first), middle));
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

HWY_INLINE void store_boxes(const Range (&range)[3], float slack, std::size_t first,
                            LaneBoxes& out) {
  const FloatLanes d;
  const auto wide = hn::Set(d, slack);
  for (int k = 0; k < 3; ++k) {
    hn::Store(hn::Sub(range[k].lo, wide), d, out.lo[k] + first);
    hn::Store(hn::Add(range[k].hi, wide), d, out.hi[k] + first);
  }
}

// The block's first home cell is that of most of its vertices.
HWY_NOINLINE void bound_pieces(const LazyState& state, const TreeBlock& block, BlockBounds& out) {
  const FloatLanes d;
  const Range nothing{hn::Set(d, kInfinity), hn::Set(d, -kInfinity)};
  for (std::size_t first = 0; first < kBlockWidth; first += hn::Lanes(d)) {
    SlabDirection n;
    Range total[3] = {nothing, nothing, nothing}, slab = nothing;
    for (std::uint32_t p = block.begin; p < block.end; ++p) {
      const HomePieces& home = state.tree->pieces[p];
      const CellCorners corners = corners_in_frame(state, home.cell);
      const PieceLanes piece = piece_lanes(home, first);
      Expansion x[3];
      for (int k = 0; k < 3; ++k) x[k] = expand(corners.axis[k], piece.middle);
      if (p == block.begin) n = slab_direction(x, state.tree->slabs[block.slabs], first);
      const auto bits = static_cast<std::uint8_t>(home.children >> first);
      const auto present = hn::LoadMaskBits(d, &bits);
      for (int k = 0; k < 3; ++k) join(total[k], range_over(x[k], piece.half), present);
      join(slab, slab_range(along(n, x), home, piece, n, first), present);
    }
    store_boxes(total, state.slack, first, out.box);
    store_slabs(slab, n, state.slab_slack, first, out.slab);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
