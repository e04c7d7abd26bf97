// Which children of a block may meet a child of another body: boxes, then slabs.
// Compiled once per instruction set (kernels.cpp).

#if defined(CONTACTCHECK_LAZY_MEETING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_MEETING_INL
#undef CONTACTCHECK_LAZY_MEETING_INL
#else
#define CONTACTCHECK_LAZY_MEETING_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/lazy/bounds-inl.h"
#include "core/lazy/lazy_state.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The bits that are set, lowest first: for (std::uint32_t bit : Bits(word)).
class Bits {
 public:
  explicit Bits(std::uint32_t word) : word_(word) {}
  Bits begin() const { return *this; }
  Bits end() const { return Bits(0); }
  std::uint32_t operator*() const { return static_cast<std::uint32_t>(std::countr_zero(word_)); }
  Bits& operator++() {
    word_ &= word_ - 1;
    return *this;
  }
  bool operator!=(const Bits& other) const { return word_ != other.word_; }

 private:
  std::uint32_t word_;
};

// Translation from one body's frame to another's, with the slack that covers its rounding. Over a
// step it grows evenly from the offset at the start to that at the end.
struct Translation {
  float low[3], high[3];         // of boxes: below and above all of it
  float middle[3], half_way[3];  // of slabs: at t = 1/2, and its half growth
  float slab_slack;              // of slabs
  bool moves;                    // it grows
  bool none;                     // both have one frame and one reach: either's slack covers a test
};

// One child's bounds, read in place: copies of single floats into a struct that vectors are
// loaded from next would wait for the stores.
struct ChildBounds {
  const LaneBoxes& box;
  const LaneSlabs* slab;
  std::uint32_t lane;
  float lo(int k) const { return box.lo[k][lane]; }
  float hi(int k) const { return box.hi[k][lane]; }
  float normal(int k) const { return slab->normal[k][lane]; }
  float middle() const { return slab->middle[lane]; }
  float half() const { return slab->half[lane]; }
  static float slab_slack() { return 0.0f; }
};

// ChildBounds moved into another body's frame, over all translations of a step, and rounded
// outward.
struct MovedBounds {
  const ChildBounds& child;
  const Translation& translation;
  float lo(int k) const { return child.lo(k) + translation.low[k]; }
  float hi(int k) const { return child.hi(k) + translation.high[k]; }
  float normal(int k) const { return child.normal(k); }
  float middle() const {
    float out = child.middle();
    for (int k = 0; k < 3; ++k) out += child.normal(k) * translation.middle[k];
    return out;
  }
  float half() const {
    const float out = child.half() + slab_slack();
    if (!translation.moves) return out;
    float way = 0.0f;
    for (int k = 0; k < 3; ++k) way += child.normal(k) * translation.half_way[k];
    return out + std::abs(way);
  }
  float slab_slack() const { return translation.slab_slack; }
};

// The largest float that is no larger, and the smallest that is no smaller.
HWY_INLINE float float_below(double x) {
  const auto near = static_cast<float>(x);
  return static_cast<double>(near) <= x ? near : std::nextafter(near, -kInfinity);
}
HWY_INLINE float float_above(double x) { return -float_below(-x); }

// The translation from the frame of `from` to that of `to`.
//
// Claim: MovedBounds hold the bounds, moved by all of the translation, and the slack covers all
// rounding of a test of slabs with them. Over a step, a point of `from` at time t lies, in the
// frame of `to` at t, within its bounds moved by the offset at t. Offsets are those at both ends,
// weighted by 1 - t and t: a segment.
//
// Notation, as in bounds-inl.h: u = 2^-24; r is the sum of both reaches and the largest growth of
// the offset along an axis, 0 in a frame. Bounds of a child have |coordinates| of at most 2.9 r,
// its slab |middle| + half of at most 15.3 r.
//
// Assumption: the bodies' boxes meet, over a step at some t (may_meet), so both offsets are at most
// r per axis. Where one is larger than 2 r (beyond the doubles) nothing is excluded, by a finite
// slack: empty lanes stay empty.
//
// Boxes:
//   * The difference of two origins rounds by at most 2^-53 of itself, in double. 2^-52 of the
//     longest offset is taken (`rounding`).
//   * It is then rounded to a float outward.
//   * Its sum with a bound is compared with a float. Rounding is monotone and leaves a float as it
//     is, so the exact sum compares as the rounded one, or as equal.
//
// Slabs, along a normal of length 1. The slack is in both comparisons of not_separated():
//   * The float offset is wrong by sqrt(3) u r and its products with the normal by as much. Three
//     sums for the middle, and one for half, are at most 15.3 r + sqrt(3) r = 17.1 r: 3 * 17.1 u r,
//     with the products 55 u r.
//   * Half of the growth along the normal, at most sqrt(3) r / 2, is wrong by as much u as a float,
//     in three products and two sums, and is added to half: 6 * 0.87 u r, and 17.1 u r for the sum.
//     In all below 23 u r.
//   * A moved box has |coordinates| of at most 3.9 r, rounded once: sqrt(3) * 3.9 u r, below 7 u r.
//   * A test (bounds-inl.h) of slabs with W = 17.1 r and boxes with B = 3.9 r, sqrt(3) B below
//     6.8 r: 2.5 for n - a m; 5 * 17.1 cos + 5 * 6.8 sin, below 93, for the sums (the slack is one
//     more); for the comparison 17.1 and 17.1 cos + 6.8 sin, below 36. In all 131.5 u r.
//   * In all 55 + 23 + 7 + 131.5 = 216.5 u r; 256 u r is taken.
//
// What underflows, of doubles or of floats, is below 1e-37 in all, which the slacks of the child's
// own bounds have for it.
HWY_INLINE Translation translation_between(const LazyState& from, const LazyState& to) {
  constexpr double kUnit = 0x1p-24, kEverything = 1e29;
  const Vec3 &from_end = from.end != nullptr ? from.end->origin : from.origin,
             &to_end = to.end != nullptr ? to.end->origin : to.origin;
  double start[3], end[3], longest = 0.0, widest = 0.0;
  for (int k = 0; k < 3; ++k) {
    start[k] = (from.origin[k] - to.origin[k]) * to.scale;
    end[k] = (from_end[k] - to_end[k]) * to.scale;
    longest = std::max({longest, std::abs(start[k]), std::abs(end[k])});
    widest = std::max(widest, std::abs(end[k] - start[k]));
  }
  const double r = from.reach + to.reach + widest;
  // False for NaN and infinity, too.
  const bool sound = longest <= 2.0 * r + 1e-30 && r < kEverything;
  const double rounding = sound ? 0x1p-52 * longest : kEverything;
  Translation out;
  out.moves = false;
  for (int k = 0; k < 3; ++k) {
    if (!sound) start[k] = end[k] = 0.0;
    out.low[k] = float_below(std::min(start[k], end[k]) - rounding);
    out.high[k] = float_above(std::max(start[k], end[k]) + rounding);
    out.middle[k] = static_cast<float>(0.5 * start[k] + 0.5 * end[k]);
    out.half_way[k] = static_cast<float>(0.5 * (end[k] - start[k]));
    out.moves |= end[k] != start[k];
  }
  out.slab_slack = static_cast<float>(sound ? 256 * kUnit * r : kEverything);
  out.none = !out.moves && from.origin == to.origin && from.reach == to.reach;
  return out;
}

// Bit i is not set where a plane parallel to the slab of lane i or to that of `one` is seen to
// separate the two.
//
// Claim: where it is not set, the two children share no point.
//   1. Let n be the normal of `one`, m that of the lane, and x a point of both. For any number a
//        n.x = a (m.x) + (n - a m).x
//   2. m.x lies in the lane's slab, so a (m.x) is within |a| half of a middle.
//   3. x lies in the lane's box, so (n - a m).x is within |n - a m|.(hi - lo) / 2 of
//      (n - a m).(lo + hi) / 2.
//   4. The sums of 2 and 3 are `their_half` and `theirs`. n.x is also within half1 of middle1. So
//      |middle1 - theirs| <= half1 + their_half.
//   5. With n and m exchanged, |middle - ours| <= half + our_half.
//   6. Bit i is cleared where 4 or 5 is violated.
// Every a is right. a = n.m (along) leaves the shortest n - a m and m - a n. Slacks cover the
// rounding (bounds-inl.h). That of a translation is part of half1, which comes |a| times in 5: it
// is added there.
template <class Bounds>
HWY_INLINE std::uint32_t not_separated(const Bounds& one, const BlockBounds& lanes) {
  const FloatLanes d;
  const auto point5 = hn::Set(d, 0.5f);
  const auto middle1 = hn::Set(d, one.middle()), half1 = hn::Set(d, one.half());
  const auto moved = hn::Set(d, one.slab_slack());
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
    FloatVec n[3], m[3];
    auto along = hn::Zero(d);
    for (int k = 0; k < 3; ++k) {
      n[k] = hn::Set(d, one.normal(k));
      m[k] = hn::Load(d, lanes.slab.normal[k] + i);
      along = hn::MulAdd(n[k], m[k], along);
    }
    const auto size = hn::Abs(along);
    const auto middle = hn::Load(d, lanes.slab.middle + i);
    const auto half = hn::Load(d, lanes.slab.half + i);
    auto theirs = hn::Mul(along, middle), their_half = hn::Mul(size, half);
    auto ours = hn::Mul(along, middle1), our_half = hn::MulAdd(size, half1, moved);
    for (int k = 0; k < 3; ++k) {
      const auto lo = hn::Load(d, lanes.box.lo[k] + i), hi = hn::Load(d, lanes.box.hi[k] + i);
      const auto rest = hn::NegMulAdd(along, m[k], n[k]);
      theirs = hn::MulAdd(rest, hn::Mul(point5, hn::Add(lo, hi)), theirs);
      their_half = hn::MulAdd(hn::Abs(rest), hn::Mul(point5, hn::Sub(hi, lo)), their_half);
      const auto lo1 = hn::Set(d, one.lo(k)), hi1 = hn::Set(d, one.hi(k));
      const auto rest1 = hn::NegMulAdd(along, n[k], m[k]);
      ours = hn::MulAdd(rest1, hn::Mul(point5, hn::Add(lo1, hi1)), ours);
      our_half = hn::MulAdd(hn::Abs(rest1), hn::Mul(point5, hn::Sub(hi1, lo1)), our_half);
    }
    const auto separated =
        hn::Or(hn::Gt(hn::Abs(hn::Sub(middle1, theirs)), hn::Add(half1, their_half)),
               hn::Gt(hn::Abs(hn::Sub(middle, ours)), hn::Add(half, our_half)));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Not(separated), bits);
    out |= static_cast<std::uint32_t>(bits[0]) << i;
  }
  return out;
}

// Bit i: the box of lane i overlaps that of `one`.
template <class Bounds>
HWY_INLINE std::uint32_t overlapping(const Bounds& one, const LaneBoxes& lanes) {
  const FloatLanes d;
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
    auto hit = hn::Le(hn::Load(d, lanes.lo[0] + i), hn::Set(d, one.hi(0)));
    hit = hn::And(hit, hn::Le(hn::Set(d, one.lo(0)), hn::Load(d, lanes.hi[0] + i)));
    for (int k = 1; k < 3; ++k) {
      hit = hn::And(hit, hn::Le(hn::Load(d, lanes.lo[k] + i), hn::Set(d, one.hi(k))));
      hit = hn::And(hit, hn::Le(hn::Set(d, one.lo(k)), hn::Load(d, lanes.hi[k] + i)));
    }
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hit, bits);
    out |= static_cast<std::uint32_t>(bits[0]) << i;
  }
  return out;
}

template <class Bounds>
HWY_INLINE std::uint32_t meeting_lanes(const Bounds& one, bool slabs, const BlockBounds& lanes) {
  const std::uint32_t hits = overlapping(one, lanes.box);
  return hits != 0 && slabs ? hits & not_separated(one, lanes) : hits;
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
