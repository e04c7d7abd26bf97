// Boxes and slabs of pieces, by expansions of the trilinear map (lattice_tree.h has the derivation,
// bounds-inl.h that of the slacks). Compiled once per instruction set (kernels.cpp).

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

// Lower and upper bounds, one per lane.
struct Range {
  FloatVec lo, hi;
};

// Four floats of every lane, lane by lane and transposed.
struct Rows {
  FloatVec part[4];
};

#if HWY_TARGET == HWY_SCALAR
template <class RowOfLane>
HWY_INLINE Rows load_rows(RowOfLane&& row) {
  Rows out{};
  for (int k = 0; k < 4; ++k) out.part[k] = hn::Set(FloatLanes(), row(0)[k]);
  return out;
}
#else
// Lanes i and i + 4 share a vector: the transposition works on blocks of four.
template <class RowOfLane>
HWY_INLINE FloatVec row_of_blocks(RowOfLane&& row, std::size_t i) {
  const hn::CappedTag<float, 4> four;
  if constexpr (hn::MaxLanes(FloatLanes()) == 4) {
    return hn::Load(four, row(i));
  } else {
    return hn::Combine(FloatLanes(), hn::Load(four, row(i + 4)), hn::Load(four, row(i)));
  }
}

template <class RowOfLane>
HWY_INLINE Rows load_rows(RowOfLane&& row) {
  const FloatLanes d;
  const hn::RepartitionToWide<FloatLanes> pairs;
  const auto a = row_of_blocks(row, 0), b = row_of_blocks(row, 1);
  const auto c = row_of_blocks(row, 2), e = row_of_blocks(row, 3);
  const auto wide = [&](auto v) HWY_ATTR { return hn::BitCast(pairs, v); };
  const auto xy0 = wide(hn::InterleaveLower(d, a, b)), xy1 = wide(hn::InterleaveLower(d, c, e));
  const auto zw0 = wide(hn::InterleaveUpper(d, a, b)), zw1 = wide(hn::InterleaveUpper(d, c, e));
  return {{hn::BitCast(d, hn::InterleaveLower(pairs, xy0, xy1)),
           hn::BitCast(d, hn::InterleaveUpper(pairs, xy0, xy1)),
           hn::BitCast(d, hn::InterleaveLower(pairs, zw0, zw1)),
           hn::BitCast(d, hn::InterleaveUpper(pairs, zw0, zw1))}};
}
#endif

// Quantised values of the lanes from `first` on. Floats represent them exactly.
template <class Step>
HWY_INLINE FloatVec steps_of(const std::array<Step, kBlockWidth>& steps, std::size_t first) {
  const FloatLanes d;
  const hn::Rebind<Step, FloatLanes> narrow;
  const hn::Rebind<std::int32_t, FloatLanes> d32;
  return hn::ConvertTo(d, hn::PromoteTo(d32, hn::LoadU(narrow, steps.data() + first)));
}

// Middle and half-widths of each lane's piece. They are exact: sums and differences of 16-bit
// integers, times a power of two.
struct Middles {
  FloatVec at[3], half[3];
};

HWY_INLINE Middles middles_of(const PieceLanes& pieces, std::size_t first) {
  const auto half_step = hn::Set(FloatLanes(), static_cast<float>(0.5 / PieceLanes::kSteps));
  Middles out{};
  for (int k = 0; k < 3; ++k) {
    const auto lo = steps_of(pieces.lo[k], first), hi = steps_of(pieces.hi[k], first);
    out.at[k] = hn::Mul(half_step, hn::Add(lo, hi));
    out.half[k] = hn::Mul(half_step, hn::Sub(hi, lo));
  }
  return out;
}

// A trilinear function about a point c: value f(c), gradient g and mixed derivatives at c, with
//   f(c + d) = f(c) + g.d + f_st ds dt + f_su ds du + f_tu dt du + f_stu ds dt du
struct Expansion {
  FloatVec value, gradient[3], st, su, tu, stu;
};

// `term`: as in CellTerms. Every result is one blend a + y b of two others, or of two terms:
//   f_stu                    = term 7
//   f_st, f_su, f_tu         = term + y term 7
//   the slopes g             = a blend of terms + y times a mixed derivative
//   f                        = a blend of terms + yt times another, + ys times the slope along s
HWY_INLINE Expansion expand(const FloatVec (&term)[8], const FloatVec (&at)[3]) {
  Expansion out{};
  out.stu = term[7];
  out.st = hn::MulAdd(at[2], term[7], term[3]);
  out.su = hn::MulAdd(at[1], term[7], term[5]);
  out.tu = hn::MulAdd(at[0], term[7], term[6]);
  const auto at_t0 = hn::MulAdd(at[2], term[5], term[1]);
  const auto at_s0 = hn::MulAdd(at[2], term[6], term[2]);
  out.gradient[0] = hn::MulAdd(at[1], out.st, at_t0);
  out.gradient[1] = hn::MulAdd(at[0], out.st, at_s0);
  out.gradient[2] = hn::MulAdd(at[1], out.tu, hn::MulAdd(at[0], term[5], term[4]));
  const auto edge = hn::MulAdd(at[2], term[4], term[0]);
  out.value = hn::MulAdd(at[0], out.gradient[0], hn::MulAdd(at[1], at_s0, edge));
  return out;
}

// The coordinates x, y, z of the image of each lane's cell, about the middle of its piece.
struct Expansions {
  Expansion axis[3];
};

HWY_INLINE Expansions expand(const LazyState& state, const PieceLanes& pieces, std::size_t first,
                             const FloatVec (&at)[3]) {
  FloatVec term[3][8];
  for (int i = 0; i < 8; ++i) {
    const Rows rows = load_rows([&](std::size_t lane) HWY_ATTR {
      return state.cells[pieces.cell[first + lane]].term[i].data();
    });
    for (int k = 0; k < 3; ++k) term[k][i] = rows.part[k];
  }
  Expansions out{};
  for (int k = 0; k < 3; ++k) out.axis[k] = expand(term[k], at);
  return out;
}

// A bound of |f(c + d) - f(c) - g.d| for |d| <= e: the mixed terms at d = e,
//   |f_st| es et + |f_su| es eu + |f_tu| et eu + |f_stu| es et eu
HWY_INLINE FloatVec curvature(const Expansion& f, const FloatVec (&e)[3]) {
  const auto st = hn::Mul(e[0], e[1]);
  auto wide = hn::Mul(hn::Abs(f.st), st);
  wide = hn::MulAdd(hn::Abs(f.su), hn::Mul(e[0], e[2]), wide);
  wide = hn::MulAdd(hn::Abs(f.tu), hn::Mul(e[1], e[2]), wide);
  return hn::MulAdd(hn::Abs(f.stu), hn::Mul(st, e[2]), wide);
}

// f over |d| <= e: f(c) -+ (|g|.e + curvature).
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

// The image n of the surface's normal m:
//   * A normal is a covector. The cofactors of the Jacobian carry it to the world: n is the sum of
//     m_s (X_t x X_u), m_t (X_u x X_s) and m_u (X_s x X_t), with the derivatives X_s, X_t, X_u.
//   * Its length is made 1.
// Bounds are right along every n (lattice_tree.h). This one makes them tight.
HWY_INLINE SlabDirection slab_direction(const Expansions& x, const BlockSlabs& slabs,
                                        std::size_t first) {
  const FloatLanes d;
  SlabDirection out{};
  for (int k = 0; k < 3; ++k) out.local[k] = steps_of(slabs.normal[k], first);
  auto square = hn::Zero(d), length2 = hn::Zero(d);
  for (int k = 0; k < 3; ++k) {
    const auto &a = x.axis[(k + 1) % 3].gradient, &b = x.axis[(k + 2) % 3].gradient;
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

// The expansion of n . X, from those of the three coordinates.
HWY_INLINE Expansion along(const SlabDirection& n, const Expansions& x) {
  const auto sum = [&](auto part) HWY_ATTR {
    const auto last = hn::Mul(n.world[2], part(x.axis[2]));
    return hn::MulAdd(n.world[0], part(x.axis[0]), hn::MulAdd(n.world[1], part(x.axis[1]), last));
  };
  Expansion out{};
  out.value = sum([](const Expansion& e) HWY_ATTR { return e.value; });
  for (int k = 0; k < 3; ++k)
    out.gradient[k] = sum([k](const Expansion& e) HWY_ATTR { return e.gradient[k]; });
  out.st = sum([](const Expansion& e) HWY_ATTR { return e.st; });
  out.su = sum([](const Expansion& e) HWY_ATTR { return e.su; });
  out.tu = sum([](const Expansion& e) HWY_ATTR { return e.tu; });
  out.stu = sum([](const Expansion& e) HWY_ATTR { return e.stu; });
  return out;
}

// f = n . X over the vertices of each lane's piece, a <= m.y <= b (slab_lo, slab_hi), |d| <= e:
//   1. k = g.m / m.m (slope), any number for the proof in lattice_tree.h
//   2. g.d = k m.d + (g - k m).d
//   3. k m.d lies between k (a - m.c) (one) and k (b - m.c) (other)
//   4. |(g - k m).d| <= |g - k m|.e, to which `wide` adds the curvature
//   5. f lies between f(c) + min(one, other) - wide and f(c) + max(one, other) + wide
HWY_INLINE Range slab_range(const Expansion& f, const PieceLanes& pieces, const Middles& middle,
                            const SlabDirection& n, std::size_t first) {
  const FloatLanes d;
  auto slope = hn::Zero(d), centre = hn::Zero(d);
  for (int k = 0; k < 3; ++k) {
    slope = hn::MulAdd(f.gradient[k], n.local[k], slope);
    centre = hn::MulAdd(middle.at[k], n.local[k], centre);
  }
  slope = hn::Mul(slope, n.inverse_square);
  auto wide = curvature(f, middle.half);
  for (int k = 0; k < 3; ++k)
    wide =
        hn::MulAdd(hn::Abs(hn::NegMulAdd(slope, n.local[k], f.gradient[k])), middle.half[k], wide);
  const auto one = hn::Mul(slope, hn::Sub(hn::LoadU(d, pieces.slab_lo.data() + first), centre));
  const auto other = hn::Mul(slope, hn::Sub(hn::LoadU(d, pieces.slab_hi.data() + first), centre));
  return {hn::Sub(hn::Add(f.value, hn::Min(one, other)), wide),
          hn::Add(hn::Add(f.value, hn::Max(one, other)), wide)};
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
