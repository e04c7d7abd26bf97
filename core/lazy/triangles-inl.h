// Eight pairs of triangles at a time: the generic case of triangles_intersect() (core/narrow), with
// its filter, on vector lanes. That function decides what the filter cannot, so the answers are the
// same. Compiled once per instruction set (kernels.cpp).
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

template <class Real>
HWY_INLINE PointOf<Real> extents(const PointOf<Real> (&p)[3], const PointOf<Real> (&q)[3]) {
  return {extent<Real>(p[0].x, p[1].x, p[2].x, q[0].x, q[1].x, q[2].x),
          extent<Real>(p[0].y, p[1].y, p[2].y, q[0].y, q[1].y, q[2].y),
          extent<Real>(p[0].z, p[1].z, p[2].z, q[0].z, q[1].z, q[2].z)};
}

// The error bound where the filter may use it, else infinity.
template <class Real>
HWY_INLINE PairVec<Real> sound_bound(PairVec<Real> product, const PointOf<Real>& extents) {
  using Filter = LaneFilter<Real>;
  const PairLanes<Real> d;
  const auto bound = hn::Mul(hn::Set(d, Filter::kErrorFactor), product);
  const auto sound = hn::And(hn::Ge(bound, hn::Set(d, Filter::kSmallestBound)),
                             hn::Le(hn::Max(hn::Max(extents.x, extents.y), extents.z),
                                    hn::Set(d, Filter::kLargestDifference)));
  return hn::IfThenElse(sound, bound, hn::Set(d, std::numeric_limits<Real>::infinity()));
}

// Error bound of every determinant of the lane.
template <class Real>
HWY_INLINE PairVec<Real> error_bound(const PointOf<Real> (&p)[3], const PointOf<Real> (&q)[3]) {
  const PointOf<Real> e = extents(p, q);
  return sound_bound<Real>(hn::Mul(hn::Mul(e.x, e.y), e.z), e);
}

// Lanes in which a point is above or below a plane; in neither set the sign is unknown.
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

// Decides lanes with unknown verdicts: triangles with a common corner meet.
template <class Real>
HWY_INLINE Verdict<Real> look_for_corners(const PointOf<Real> (&p)[3], const PointOf<Real> (&q)[3],
                                          const Verdict<Real>& found) {
  if (hn::AllFalse(PairLanes<Real>(), found.unknown)) return found;
  const auto share = hn::And(found.unknown, share_a_corner(p, q));
  return {hn::Or(found.meet, share), hn::AndNot(share, found.unknown)};
}

// For coplanar triangles all determinants are zero. Where they are separated in the view along an
// axis, which signs of areas decide, they are separated in space.
//
// Claim: in such a view a line holds corners of one triangle and has its third corner, or has all
// of its corners but a shared one, on one side (or on it), and all corners of the other one, but
// shared ones, strictly on the other. Then the two share no point but those of shared corners.
//   * A point of the other triangle off the hull of shared corners is strictly on its side.
//   * Where two corners are shared, the line is theirs, and each third corner strictly on its side.
//
// Claim: the sign of an area that exceeds its bound, 48 e X Y of the extents in the view, is right.
//   * An area is off by at most 8 e X Y and terms of e^2: 3 e of each of two products, whose
//     factors are differences, and e of their difference. The difference of two areas is off by at
//     most twice that and 4 e X Y more.
//   * Underflow and overflow: as above, with one factor less.
template <class Real>
class Views {
 public:
  Views(const PointOf<Real> (&p)[3], const PointOf<Real> (&q)[3]) {
    const PointOf<Real> e = extents(p, q);
    bounds_ = {sound_bound<Real>(hn::Mul(e.y, e.z), e), sound_bound<Real>(hn::Mul(e.z, e.x), e),
               sound_bound<Real>(hn::Mul(e.x, e.y), e)};
  }

  // Lanes in which, in some view, all areas have one sign.
  template <class... Areas>
  HWY_INLINE PairMask<Real> alike(const PointOf<Real>& first, const Areas&... others) const {
    const auto in_view = [](PairVec<Real> bound, PairVec<Real> area, auto... areas) HWY_ATTR {
      auto least = area, most = area;
      ((least = hn::Min(least, areas), most = hn::Max(most, areas)), ...);
      return hn::Or(hn::Gt(least, bound), hn::Lt(most, hn::Neg(bound)));
    };
    return hn::Or(
        in_view(bounds_.x, first.x, others.x...),
        hn::Or(in_view(bounds_.y, first.y, others.y...), in_view(bounds_.z, first.z, others.z...)));
  }

 private:
  PointOf<Real> bounds_;
};

// Lanes in which the line of an edge of p separates the triangles in some view.
template <class Real>
HWY_INLINE PairMask<Real> apart_by_edges(const Views<Real>& views, const PointOf<Real> (&p)[3],
                                         const PointOf<Real> (&q)[3]) {
  const auto by_edge = [&](int i) HWY_ATTR {
    const PointOf<Real>& from = p[i];
    const PointOf<Real> along = minus(p[(i + 1) % 3], from);
    return views.alike(cross(along, minus(p[(i + 2) % 3], from)), cross(minus(q[0], from), along),
                       cross(minus(q[1], from), along), cross(minus(q[2], from), along));
  };
  return hn::Or(by_edge(0), hn::Or(by_edge(1), by_edge(2)));
}

// Returns the unknown lanes that no view separates; `shared` corners come first in both.
template <class Real>
HWY_NOINLINE PairMask<Real> look_at_views(const PointOf<Real> (&p)[3], const PointOf<Real> (&q)[3],
                                          std::uint32_t shared, PairMask<Real> unknown) {
  if (hn::AllFalse(PairLanes<Real>(), unknown)) return unknown;
  const Views<Real> views(p, q);
  if (shared == 0)
    return hn::AndNot(hn::Or(apart_by_edges(views, p, q), apart_by_edges(views, q, p)), unknown);
  const PointOf<Real> p1 = minus(p[1], p[0]), p2 = minus(p[2], p[0]), q1 = minus(q[1], q[0]),
                      q2 = minus(q[2], q[0]);
  if (shared == 2) return hn::AndNot(views.alike(cross(p1, p2), cross(q2, p1)), unknown);
  // Lines through the corner: along its four edges, and along those opposite to it.
  const PointOf<Real> pp = cross(p1, p2), qq = cross(q1, q2), c11 = cross(p1, q1),
                      c12 = cross(p1, q2), c21 = cross(p2, q1), c22 = cross(p2, q2);
  const PointOf<Real> none = minus(p[0], p[0]);
  auto apart =
      hn::Or(views.alike(pp, minus(none, c11), minus(none, c12)), views.alike(pp, c21, c22));
  apart = hn::Or(apart, views.alike(pp, minus(c21, c11), minus(c22, c12)));
  apart = hn::Or(apart, views.alike(qq, c11, c21));
  apart = hn::Or(apart, views.alike(qq, minus(none, c12), minus(none, c22)));
  apart = hn::Or(apart, views.alike(qq, minus(c11, c12), minus(c21, c22)));
  return hn::AndNot(apart, unknown);
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
                             look_at_views(p, q, 0, hn::Not(hn::Or(separated, known)))};
  return look_for_corners(p, q, out);
}

// Triangles whose first corner is the same point: the filter of meet_beyond_corner() (core/narrow).
template <class Real>
HWY_INLINE Verdict<Real> test_corner_lanes(const TriangleBatchOf<Real>& batch, std::size_t first) {
  PointOf<Real> p[3] = {}, q[3] = {};
  for (int c = 0; c < 3; ++c) {
    p[c] = load_corner(batch, 0, c, first);
    q[c] = load_corner(batch, 1, c, first);
  }
  const auto bound = error_bound(p, q), minus_bound = hn::Neg(bound);
  const auto p_normal = cross(minus(p[1], p[0]), minus(p[2], p[0]));
  const auto q_normal = cross(minus(q[1], q[0]), minus(q[2], q[0]));
  PairMask<Real> p_above[2], p_below[2], q_above[2], q_below[2];
  for (int i = 0; i < 2; ++i) {
    const auto p_side = dot(q_normal, minus(p[i + 1], q[0]));
    const auto q_side = dot(p_normal, minus(q[i + 1], p[0]));
    p_above[i] = hn::Gt(p_side, bound), p_below[i] = hn::Lt(p_side, minus_bound);
    q_above[i] = hn::Gt(q_side, bound), q_below[i] = hn::Lt(q_side, minus_bound);
  }
  const auto separated =
      hn::Or(hn::Or(hn::And(p_above[0], p_above[1]), hn::And(p_below[0], p_below[1])),
             hn::Or(hn::And(q_above[0], q_above[1]), hn::And(q_below[0], q_below[1])));
  const auto known =
      hn::And(hn::And(hn::Or(p_above[0], p_below[0]), hn::Or(p_above[1], p_below[1])),
              hn::And(hn::Or(q_above[0], q_below[0]), hn::Or(q_above[1], q_below[1])));
  const auto alike = hn::Or(hn::And(q_above[0], p_above[1]), hn::And(q_below[0], p_below[1]));
  return {hn::And(hn::AndNot(separated, known), alike),
          look_at_views(p, q, 1, hn::Not(hn::Or(separated, known)))};
}

// Triangles whose first two corners are the same points: they meet in more only in one plane.
template <class Real>
HWY_INLINE Verdict<Real> test_edge_lanes(const TriangleBatchOf<Real>& batch, std::size_t first) {
  PointOf<Real> p[3] = {}, q[3] = {};
  for (int c = 0; c < 3; ++c) {
    p[c] = load_corner(batch, 0, c, first);
    q[c] = load_corner(batch, 1, c, first);
  }
  const auto bound = error_bound(p, q);
  const auto side = determinant(p[0], p[1], p[2], q[2]);
  const auto off = hn::Or(hn::Gt(side, bound), hn::Lt(side, hn::Neg(bound)));
  return {hn::And(off, hn::Not(off)), look_at_views(p, q, 2, hn::Not(off))};
}

template <class Real>
HWY_NOINLINE BatchVerdict test_batch_in(const TriangleBatchOf<Real>& batch) {
  const PairLanes<Real> d;
  BatchVerdict out;
  for (std::size_t first = 0; first < batch.count; first += hn::Lanes(d)) {
    const Verdict<Real> verdict = batch.shared == 0   ? test_lanes(batch, first)
                                  : batch.shared == 1 ? test_corner_lanes(batch, first)
                                                      : test_edge_lanes(batch, first);
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
