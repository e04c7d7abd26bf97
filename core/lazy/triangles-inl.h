// Eight pairs of triangles at a time: the generic case of triangles_intersect() (core/narrow), with
// its filter, on vector lanes. Whatever the filter cannot decide is left to that function, so the
// answers are the same. Compiled once per instruction set (kernels.cpp).
//
// Claim: the sign of a determinant that exceeds error_bound() is right (LaneFilter).
//   * The operations and their order are those of orient3d. None is fused.
//   * orient3d's bound has the largest |differences| X, Y, Z that a determinant computes. This one
//     has the extents of both triangles together.
//   * The extents are no smaller: the computed difference of two values is at most the computed
//     difference of the largest and the smallest.

#if defined(CONTACTCHECK_LAZY_TRIANGLES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_TRIANGLES_INL
#undef CONTACTCHECK_LAZY_TRIANGLES_INL
#else
#define CONTACTCHECK_LAZY_TRIANGLES_INL
#endif

#include <hwy/highway.h>

#include <limits>

#include "core/lazy/triangle_batch.h"
#include "core/narrow/predicates.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// When the sign of a determinant on a lane may be trusted.
//
// Claim: 48 e X Y Z is an upper bound of its error, X, Y, Z the largest |differences| per axis and
// e the rounding error of its numbers.
//   * Doubles: narrow/predicates.cpp, which also has the constants.
//   * Floats, e = 2^-24: that derivation asks of e only that 200 e^2 and 3 e are far below e. What
//     differs is the range of the numbers:
//   * Assumption: differences are at most 2^41, as of coordinates within kSingleLimit.
//   * Underflow: a product is wrong by another n = 2^-150 at most, a determinant by
//     3 (2 n max(X, Y, Z) + n) and roundings thereof, below 2^-106. The bound is at least 2^-99, so
//     e X Y Z, a 48th of it and more than 2^-105, covers that.
//   * Underflow within the bound: if fl(X Y) underflowed, the bound would be below
//     2^-126 * 2^41 * 2^-18 and fail its test.
//   * Overflow: no sum is above 6 * 2^123.
template <typename Real>
struct LaneFilter;

template <>
struct LaneFilter<double> {
  static constexpr double kErrorFactor = kOrient3dErrorFactor;
  static constexpr double kSmallestBound = kFilterSmallestBound;
  static constexpr double kLargestDifference = kFilterLargestDifference;
};

template <>
struct LaneFilter<float> {
  static constexpr float kErrorFactor = 48 * 0x1p-24f;
  static constexpr float kSmallestBound = 0x1p-99f;
  static constexpr float kLargestDifference = 0x1p41f;
};

template <class Real>
using PairLanes = hn::CappedTag<Real, kBatchWidth>;
template <class Real>
using PairVec = hn::Vec<PairLanes<Real>>;
template <class Real>
using PairMask = hn::Mask<PairLanes<Real>>;

template <class Real>
struct PointOf {
  PairVec<Real> x, y, z;
};

template <class Real>
HWY_INLINE PointOf<Real> load_corner(const TriangleBatchOf<Real>& batch, int triangle, int corner,
                                     std::size_t first) {
  const PairLanes<Real> d;
  const auto& axes = batch.corner[triangle][corner];
  return {hn::Load(d, axes[0] + first), hn::Load(d, axes[1] + first), hn::Load(d, axes[2] + first)};
}

template <class Real>
HWY_INLINE PointOf<Real> minus(const PointOf<Real>& a, const PointOf<Real>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

template <class Real>
HWY_INLINE PointOf<Real> select(PairMask<Real> which, const PointOf<Real>& yes,
                                const PointOf<Real>& no) {
  return {hn::IfThenElse(which, yes.x, no.x), hn::IfThenElse(which, yes.y, no.y),
          hn::IfThenElse(which, yes.z, no.z)};
}

// (u x v) in orient3d's order.
template <class Real>
HWY_INLINE PointOf<Real> cross(const PointOf<Real>& u, const PointOf<Real>& v) {
  using Vec = PairVec<Real>;
  const auto minor = [](Vec a, Vec b, Vec c, Vec e)
                         HWY_ATTR { return hn::Sub(hn::Mul(a, b), hn::Mul(c, e)); };
  return {minor(u.y, v.z, u.z, v.y), minor(u.z, v.x, u.x, v.z), minor(u.x, v.y, u.y, v.x)};
}

template <class Real>
HWY_INLINE PairVec<Real> dot(const PointOf<Real>& n, const PointOf<Real>& w) {
  return hn::Add(hn::Add(hn::Mul(n.x, w.x), hn::Mul(n.y, w.y)), hn::Mul(n.z, w.z));
}

template <class Real>
HWY_INLINE PairVec<Real> determinant(const PointOf<Real>& a, const PointOf<Real>& b,
                                     const PointOf<Real>& c, const PointOf<Real>& e) {
  return dot(cross(minus(b, a), minus(c, a)), minus(e, a));
}

template <class Real>
HWY_INLINE PairVec<Real> extent(PairVec<Real> a, PairVec<Real> b, PairVec<Real> c, PairVec<Real> e,
                                PairVec<Real> f, PairVec<Real> g) {
  const auto hi = hn::Max(hn::Max(hn::Max(a, b), hn::Max(c, e)), hn::Max(f, g));
  const auto lo = hn::Min(hn::Min(hn::Min(a, b), hn::Min(c, e)), hn::Min(f, g));
  return hn::Sub(hi, lo);
}

// Error bound of every determinant of the lane; infinite where the filter must not decide.
template <class Real>
HWY_INLINE PairVec<Real> error_bound(const PointOf<Real> (&p)[3], const PointOf<Real> (&q)[3]) {
  using Filter = LaneFilter<Real>;
  const PairLanes<Real> d;
  const auto x = extent<Real>(p[0].x, p[1].x, p[2].x, q[0].x, q[1].x, q[2].x);
  const auto y = extent<Real>(p[0].y, p[1].y, p[2].y, q[0].y, q[1].y, q[2].y);
  const auto z = extent<Real>(p[0].z, p[1].z, p[2].z, q[0].z, q[1].z, q[2].z);
  const auto bound = hn::Mul(hn::Set(d, Filter::kErrorFactor), hn::Mul(hn::Mul(x, y), z));
  const auto sound =
      hn::And(hn::Ge(bound, hn::Set(d, Filter::kSmallestBound)),
              hn::Le(hn::Max(hn::Max(x, y), z), hn::Set(d, Filter::kLargestDifference)));
  return hn::IfThenElse(sound, bound, hn::Set(d, std::numeric_limits<Real>::infinity()));
}

// Where three signs are known: which lanes are above and below.
template <class Real>
struct Sides {
  PairMask<Real> above[3], below[3];
  PairMask<Real> known() const {
    auto all = hn::Or(above[0], below[0]);
    for (int i = 1; i < 3; ++i) all = hn::And(all, hn::Or(above[i], below[i]));
    return all;
  }
  PairMask<Real> one_side() const {
    return hn::Or(hn::And(hn::And(above[0], above[1]), above[2]),
                  hn::And(hn::And(below[0], below[1]), below[2]));
  }
};

template <class Real>
HWY_INLINE Sides<Real> sides(const PointOf<Real> (&plane)[3], const PointOf<Real> (&points)[3],
                             PairVec<Real> bound) {
  const auto normal = cross(minus(plane[1], plane[0]), minus(plane[2], plane[0]));
  Sides<Real> out{};
  for (int i = 0; i < 3; ++i) {
    const auto side = dot(normal, minus(points[i], plane[0]));
    out.above[i] = hn::Gt(side, bound);
    out.below[i] = hn::Lt(side, hn::Neg(bound));
  }
  return out;
}

// Turns the triangle so that the corner alone on its side comes first. @pre both sides occupied
template <class Real>
struct Turned {
  PointOf<Real> lone, next, last;
  PairMask<Real> lone_below;
};

template <class Real>
HWY_INLINE Turned<Real> turn(const PointOf<Real> (&p)[3], const Sides<Real>& s) {
  const auto same = [&](int i, int j) HWY_ATTR {
    return hn::Or(hn::And(s.above[i], s.above[j]), hn::And(s.below[i], s.below[j]));
  };
  const auto first = same(1, 2), second = same(0, 2);  // else the third
  Turned<Real> out{};
  out.lone = select(first, p[0], select(second, p[1], p[2]));
  out.next = select(first, p[1], select(second, p[2], p[0]));
  out.last = select(first, p[2], select(second, p[0], p[1]));
  out.lone_below =
      hn::Or(hn::And(first, s.below[0]), hn::Or(hn::And(hn::AndNot(first, second), s.below[1]),
                                                hn::AndNot(hn::Or(first, second), s.below[2])));
  return out;
}

template <class Real>
struct Verdict {
  PairMask<Real> meet, unknown;
};

template <class Real>
HWY_INLINE PairMask<Real> equal(const PointOf<Real>& a, const PointOf<Real>& b) {
  return hn::And(hn::Eq(a.x, b.x), hn::And(hn::Eq(a.y, b.y), hn::Eq(a.z, b.z)));
}

template <class Real>
HWY_INLINE PairMask<Real> share_a_corner(const PointOf<Real> (&p)[3], const PointOf<Real> (&q)[3]) {
  auto any = equal(p[0], q[0]);
  for (const PointOf<Real>& a : p)
    for (const PointOf<Real>& b : q) any = hn::Or(any, equal(a, b));
  return any;
}

// Among lanes that are unknown.
template <class Real>
HWY_INLINE Verdict<Real> look_for_corners(const PointOf<Real> (&p)[3], const PointOf<Real> (&q)[3],
                                          const Verdict<Real>& found) {
  if (hn::AllFalse(PairLanes<Real>(), found.unknown)) return found;
  const auto share = hn::And(found.unknown, share_a_corner(p, q));
  return {hn::Or(found.meet, share), hn::AndNot(share, found.unknown)};
}

template <class Real>
HWY_INLINE Verdict<Real> test_lanes(const TriangleBatchOf<Real>& batch, std::size_t first) {
  PointOf<Real> p[3] = {}, q[3] = {};
  for (int c = 0; c < 3; ++c) {
    p[c] = load_corner(batch, 0, c, first);
    q[c] = load_corner(batch, 1, c, first);
  }
  const auto bound = error_bound(p, q);
  const Sides<Real> q_sides = sides(p, q, bound);
  const Sides<Real> p_sides = sides(q, p, bound);
  const auto separated = hn::Or(q_sides.one_side(), p_sides.one_side());
  auto known = hn::And(q_sides.known(), p_sides.known());
  Turned<Real> a = turn(p, p_sides), b = turn(q, q_sides);
  const auto q1 = select(a.lone_below, b.last, b.next), q2 = select(a.lone_below, b.next, b.last);
  const auto p1 = select(b.lone_below, a.last, a.next), p2 = select(b.lone_below, a.next, a.last);
  const auto begin = determinant(a.lone, p1, b.lone, q1);
  const auto end = determinant(a.lone, p2, q2, b.lone);
  const auto minus_bound = hn::Neg(bound);
  const auto meet = hn::And(hn::Lt(begin, minus_bound), hn::Lt(end, minus_bound));
  const auto miss = hn::Or(hn::Gt(begin, bound), hn::Gt(end, bound));
  known = hn::And(known, hn::Or(meet, miss));
  const Verdict<Real> out = {hn::And(hn::AndNot(separated, known), meet),
                             hn::Not(hn::Or(separated, known))};
  return look_for_corners(p, q, out);
}

template <class Real>
HWY_NOINLINE BatchVerdict test_batch_in(const TriangleBatchOf<Real>& batch) {
  const PairLanes<Real> d;
  BatchVerdict out;
  for (std::size_t first = 0; first < batch.count; first += hn::Lanes(d)) {
    const Verdict<Real> verdict = test_lanes(batch, first);
    std::uint8_t bits[2][8] = {};
    hn::StoreMaskBits(d, verdict.meet, bits[0]);
    hn::StoreMaskBits(d, verdict.unknown, bits[1]);
    out.meet |= static_cast<std::uint32_t>(bits[0][0]) << first;
    out.unknown |= static_cast<std::uint32_t>(bits[1][0]) << first;
  }
  const std::uint32_t filled = (1u << batch.count) - 1;
  return {out.meet & filled, out.unknown & filled};
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
