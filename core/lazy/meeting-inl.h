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

struct Shift {
  float way[3], slack, slab_slack;
  bool none;  // one frame for both
};

// One child's bounds, read where they stand: copies of single floats into a struct that vectors are
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
};

// The same, moved into another body's frame, outward.
struct MovedBounds {
  const ChildBounds& child;
  const Shift& shift;
  float lo(int k) const { return child.lo(k) + (shift.way[k] - shift.slack); }
  float hi(int k) const { return child.hi(k) + (shift.way[k] + shift.slack); }
  float normal(int k) const { return child.normal(k); }
  float middle() const {
    float out = child.middle();
    for (int k = 0; k < 3; ++k) out += child.normal(k) * shift.way[k];
    return out;
  }
  float half() const { return child.half() + shift.slab_slack; }
};

// From the frame of `from` to that of `to`. With u = 2^-24 and r the reaches of both together: the
// difference of the origins is wrong by 3 * 2^-53 of them, its float and way - slack by u r each,
// and the sums in MovedBounds by u times their results, at most 9 r: below 16 u r. The
// tests of slabs compare sums of about 20 products of values up to 9 r with factors of at most 2:
// below 800 u r. The bodies' boxes overlap, so the way is at most r; else (rounding, or beyond the
// doubles) nothing is excluded, by a finite number: empty lanes stay empty.
HWY_INLINE Shift shift_between(const LazyState& from, const LazyState& to) {
  constexpr double kUnit = 0x1p-24, kEverything = 1e29;
  const double r = from.reach + to.reach;
  double origins = 0.0, longest = 0.0;
  Shift out;
  for (int k = 0; k < 3; ++k) {
    const double way = (from.origin[k] - to.origin[k]) * to.scale;
    longest = std::max(longest, std::abs(way));
    origins += (std::abs(from.origin[k]) + std::abs(to.origin[k])) * to.scale;
    out.way[k] = static_cast<float>(way);
  }
  const double rounding = 8 * 0x1p-53 * origins + 1e-36;
  // False for NaN and infinity, too.
  const bool sound = longest <= 2.0 * r + 1e-30 && rounding < kEverything;
  out.slack = static_cast<float>(sound ? rounding + 32 * kUnit * r : kEverything);
  out.slab_slack = static_cast<float>(sound ? 4 * rounding + 1024 * kUnit * r : kEverything);
  out.none = from.origin == to.origin;
  if (!sound) out.way[0] = out.way[1] = out.way[2] = 0.0f;
  return out;
}

// Bit i: no plane parallel to the slab of lane i or to that of `one` is seen to part the two. Along
// the normal n of the one, the other lies within a n' . x of its own slab, for any a, and the rest
// (n - a n') . x of its box.
template <class Bounds>
HWY_INLINE std::uint32_t not_separated(const Bounds& one, const BlockBounds& lanes) {
  const FloatLanes d;
  const auto point5 = hn::Set(d, 0.5f);
  const auto middle1 = hn::Set(d, one.middle()), half1 = hn::Set(d, one.half());
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
    auto ours = hn::Mul(along, middle1), our_half = hn::Mul(size, half1);
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

// Bit i: the box of lane i shares a point with that of `one`.
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
