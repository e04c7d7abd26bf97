// Eight pairs of triangles at a time: the generic case of triangles_intersect() (core/narrow), with
// its filter, on vector lanes. Whatever the filter cannot decide is left to that function, so the
// answers are the same. Compiled once per instruction set (kernels.cpp).
//
// Filter. orient3d is wrong by at most 48 * 2^-53 X Y Z (derivation in narrow/predicates.cpp), X,
// Y, Z the largest |differences| per axis that the call computes. Here they are replaced by the
// extents of both triangles together, which are no smaller: a computed difference of two values is
// at most the computed difference of the largest and the smallest. The operations and their order
// are those of orient3d; none is fused.

#if defined(CONTACTCHECK_LAZY_TRIANGLES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_TRIANGLES_INL
#undef CONTACTCHECK_LAZY_TRIANGLES_INL
#else
#define CONTACTCHECK_LAZY_TRIANGLES_INL
#endif

#include <hwy/highway.h>

#include "core/lazy/triangle_batch.h"
#include "core/narrow/predicates.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using PairLanes = hn::CappedTag<double, kBatchWidth>;
using PairVec = hn::Vec<PairLanes>;
using PairMask = hn::Mask<PairLanes>;

struct PointOf {
  PairVec x, y, z;
};

HWY_INLINE PointOf load_corner(const TriangleBatch& batch, int triangle, int corner,
                               std::size_t first) {
  const PairLanes d;
  const auto& axes = batch.corner[triangle][corner];
  return {hn::Load(d, axes[0] + first), hn::Load(d, axes[1] + first), hn::Load(d, axes[2] + first)};
}

HWY_INLINE PointOf minus(const PointOf& a, const PointOf& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE PointOf select(PairMask which, const PointOf& yes, const PointOf& no) {
  return {hn::IfThenElse(which, yes.x, no.x), hn::IfThenElse(which, yes.y, no.y),
          hn::IfThenElse(which, yes.z, no.z)};
}

// (u x v) in orient3d's order.
HWY_INLINE PointOf cross(const PointOf& u, const PointOf& v) {
  const auto minor = [](PairVec a, PairVec b, PairVec c, PairVec e)
                         HWY_ATTR { return hn::Sub(hn::Mul(a, b), hn::Mul(c, e)); };
  return {minor(u.y, v.z, u.z, v.y), minor(u.z, v.x, u.x, v.z), minor(u.x, v.y, u.y, v.x)};
}

HWY_INLINE PairVec dot(const PointOf& n, const PointOf& w) {
  return hn::Add(hn::Add(hn::Mul(n.x, w.x), hn::Mul(n.y, w.y)), hn::Mul(n.z, w.z));
}

HWY_INLINE PairVec determinant(const PointOf& a, const PointOf& b, const PointOf& c,
                               const PointOf& e) {
  return dot(cross(minus(b, a), minus(c, a)), minus(e, a));
}

HWY_INLINE PairVec extent(PairVec a, PairVec b, PairVec c, PairVec e, PairVec f, PairVec g) {
  const auto hi = hn::Max(hn::Max(hn::Max(a, b), hn::Max(c, e)), hn::Max(f, g));
  const auto lo = hn::Min(hn::Min(hn::Min(a, b), hn::Min(c, e)), hn::Min(f, g));
  return hn::Sub(hi, lo);
}

// Error bound of every determinant of the lane; infinite where the filter must not decide.
HWY_INLINE PairVec error_bound(const PointOf (&p)[3], const PointOf (&q)[3]) {
  const PairLanes d;
  const auto x = extent(p[0].x, p[1].x, p[2].x, q[0].x, q[1].x, q[2].x);
  const auto y = extent(p[0].y, p[1].y, p[2].y, q[0].y, q[1].y, q[2].y);
  const auto z = extent(p[0].z, p[1].z, p[2].z, q[0].z, q[1].z, q[2].z);
  const auto bound = hn::Mul(hn::Set(d, kOrient3dErrorFactor), hn::Mul(hn::Mul(x, y), z));
  const auto sound =
      hn::And(hn::Ge(bound, hn::Set(d, kFilterSmallestBound)),
              hn::Le(hn::Max(hn::Max(x, y), z), hn::Set(d, kFilterLargestDifference)));
  return hn::IfThenElse(sound, bound, hn::Set(d, std::numeric_limits<double>::infinity()));
}

// Where three signs are known: which lanes are above and below.
struct Sides {
  PairMask above[3], below[3];
  PairMask known() const {
    auto all = hn::Or(above[0], below[0]);
    for (int i = 1; i < 3; ++i) all = hn::And(all, hn::Or(above[i], below[i]));
    return all;
  }
  PairMask one_side() const {
    return hn::Or(hn::And(hn::And(above[0], above[1]), above[2]),
                  hn::And(hn::And(below[0], below[1]), below[2]));
  }
};

HWY_INLINE Sides sides(const PointOf (&plane)[3], const PointOf (&points)[3], PairVec bound) {
  const auto normal = cross(minus(plane[1], plane[0]), minus(plane[2], plane[0]));
  Sides out{};
  for (int i = 0; i < 3; ++i) {
    const auto side = dot(normal, minus(points[i], plane[0]));
    out.above[i] = hn::Gt(side, bound);
    out.below[i] = hn::Lt(side, hn::Neg(bound));
  }
  return out;
}

// Turns the triangle so that the corner alone on its side comes first. @pre both sides occupied
struct Turned {
  PointOf lone, next, last;
  PairMask lone_below;
};

HWY_INLINE Turned turn(const PointOf (&p)[3], const Sides& s) {
  const auto same = [&](int i, int j) HWY_ATTR {
    return hn::Or(hn::And(s.above[i], s.above[j]), hn::And(s.below[i], s.below[j]));
  };
  const auto first = same(1, 2), second = same(0, 2);  // else the third
  Turned out{};
  out.lone = select(first, p[0], select(second, p[1], p[2]));
  out.next = select(first, p[1], select(second, p[2], p[0]));
  out.last = select(first, p[2], select(second, p[0], p[1]));
  out.lone_below =
      hn::Or(hn::And(first, s.below[0]), hn::Or(hn::And(hn::AndNot(first, second), s.below[1]),
                                                hn::AndNot(hn::Or(first, second), s.below[2])));
  return out;
}

struct Verdict {
  PairMask meet, unknown;
};

HWY_INLINE PairMask equal(const PointOf& a, const PointOf& b) {
  return hn::And(hn::Eq(a.x, b.x), hn::And(hn::Eq(a.y, b.y), hn::Eq(a.z, b.z)));
}

HWY_INLINE PairMask share_a_corner(const PointOf (&p)[3], const PointOf (&q)[3]) {
  auto any = equal(p[0], q[0]);
  for (const PointOf& a : p)
    for (const PointOf& b : q) any = hn::Or(any, equal(a, b));
  return any;
}

HWY_INLINE Verdict test_lanes(const TriangleBatch& batch, std::size_t first) {
  PointOf p[3] = {}, q[3] = {};
  for (int c = 0; c < 3; ++c) {
    p[c] = load_corner(batch, 0, c, first);
    q[c] = load_corner(batch, 1, c, first);
  }
  const auto bound = error_bound(p, q);
  const Sides q_sides = sides(p, q, bound);
  const Sides p_sides = sides(q, p, bound);
  const auto apart = hn::Or(q_sides.one_side(), p_sides.one_side());
  auto known = hn::And(q_sides.known(), p_sides.known());
  Turned a = turn(p, p_sides), b = turn(q, q_sides);
  const auto q1 = select(a.lone_below, b.last, b.next), q2 = select(a.lone_below, b.next, b.last);
  const auto p1 = select(b.lone_below, a.last, a.next), p2 = select(b.lone_below, a.next, a.last);
  const auto begin = determinant(a.lone, p1, b.lone, q1);
  const auto end = determinant(a.lone, p2, q2, b.lone);
  const auto minus_bound = hn::Neg(bound);
  const auto meet = hn::And(hn::Lt(begin, minus_bound), hn::Lt(end, minus_bound));
  const auto miss = hn::Or(hn::Gt(begin, bound), hn::Gt(end, bound));
  known = hn::And(known, hn::Or(meet, miss));
  Verdict out = {hn::And(hn::AndNot(apart, known), meet), hn::Not(hn::Or(apart, known))};
  if (hn::AllFalse(PairLanes(), out.unknown)) return out;
  const auto share = hn::And(out.unknown, share_a_corner(p, q));
  return {hn::Or(out.meet, share), hn::AndNot(share, out.unknown)};
}

HWY_NOINLINE BatchVerdict test_batch(const TriangleBatch& batch) {
  const PairLanes d;
  BatchVerdict out;
  for (std::size_t first = 0; first < batch.count; first += hn::Lanes(d)) {
    const Verdict verdict = test_lanes(batch, first);
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
