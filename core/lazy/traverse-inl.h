// Two trees against each other, block by block, then leaf by leaf, then triangle by triangle.
// Compiled once per instruction set (kernels.cpp).

#if defined(CONTACTCHECK_LAZY_TRAVERSE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_TRAVERSE_INL
#undef CONTACTCHECK_LAZY_TRAVERSE_INL
#else
#define CONTACTCHECK_LAZY_TRAVERSE_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/lazy/kernels.h"
#include "core/lazy/leaves-inl.h"
#include "core/lazy/triangles-inl.h"

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
HWY_INLINE std::uint32_t unparted(const Bounds& one, const BlockBounds& lanes) {
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
    const auto parted =
        hn::Or(hn::Gt(hn::Abs(hn::Sub(middle1, theirs)), hn::Add(half1, their_half)),
               hn::Gt(hn::Abs(hn::Sub(middle, ours)), hn::Add(half, our_half)));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Not(parted), bits);
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
  return hits != 0 && slabs ? hits & unparted(one, lanes) : hits;
}

// A box of a leaf, or of one of its triangles, beside boxes of the other body's triangles.
HWY_INLINE std::uint32_t overlapping_triangles(const LaneBoxes& box, std::uint32_t lane,
                                               const Shift& shift, const LaneBoxes& lanes) {
  const ChildBounds one{box, nullptr, lane};
  return shift.none ? overlapping(one, lanes) : overlapping(MovedBounds{one, shift}, lanes);
}

// Steps are calls: inlined into one another they would be compiled a hundred times.
class PairTraversal {
 public:
  PairTraversal(BodiesToTest bodies, bool first_only, LazyScratch& scratch,
                std::vector<ElementPair>& out)
      : bodies_(bodies),
        first_only_(first_only),
        scratch_(scratch),
        out_(out),
        slabs_(!bodies.a.from_vertices && !bodies.b.from_vertices),
        to_a_(shift_between(bodies.b, bodies.a)),
        to_b_(shift_between(bodies.a, bodies.b)) {
    scratch.open.slots.clear();
    scratch.open.leaves.clear();
    scratch.batch.count = 0;
  }

  HWY_INLINE void run() {
    cross_roots();
    finish();
  }

  HWY_INLINE void run(const FrontPart& part) {
    scratch_.open.slots.assign(part.slots.begin(), part.slots.end());
    scratch_.open.leaves.assign(part.leaves.begin(), part.leaves.end());
    finish();
  }

  HWY_INLINE void spread(std::size_t slots, PairFront& front) {
    cross_roots();
    while (!scratch_.open.slots.empty() && scratch_.open.slots.size() < slots) {
      scratch_.level.swap(scratch_.open.slots);
      scratch_.open.slots.clear();
      for (const SlotPair& pair : scratch_.level) open(pair);
    }
    front.slots.swap(scratch_.open.slots);
    front.leaves.swap(scratch_.open.leaves);
  }

 private:
  static constexpr std::size_t kLeafPairsAtOnce = 16;

  HWY_INLINE void finish() {
    std::vector<SlotPair>& slots = scratch_.open.slots;
    const std::size_t before = out_.size();
    while (!slots.empty()) {
      const SlotPair pair = slots.back();
      slots.pop_back();
      open(pair);
      if (!first_only_ || scratch_.open.leaves.size() < kLeafPairsAtOnce) continue;
      test_leaf_pairs();
      if (out_.size() > before) break;
    }
    test_leaf_pairs();
    if (first_only_ && out_.size() > before) out_.resize(before + 1);
  }

  TreeChild child_a(std::uint32_t block, std::uint32_t lane) const {
    return bodies_.a.tree->blocks[block].child[lane];
  }
  TreeChild child_b(std::uint32_t block, std::uint32_t lane) const {
    return bodies_.b.tree->blocks[block].child[lane];
  }

  HWY_INLINE void cross_roots() {
    const auto children = [](const LazyState& body) {
      return (1u << body.tree->blocks[0].children) - 1;
    };
    cross(0, children(bodies_.a), 0, children(bodies_.b));
  }

  HWY_INLINE void meet(const SlotPair& slots) {
    const TreeChild a = child_a(slots.block_a, slots.lane_a);
    const TreeChild b = child_b(slots.block_b, slots.lane_b);
    if (a.leaf() && b.leaf()) {
      scratch_.open.leaves.push_back({a.index(), b.index()});
      ++scratch_.counters.leaf_pairs;
    } else {
      scratch_.open.slots.push_back(slots);
    }
  }

  // Lanes of a block that may meet one child of the other tree.
  HWY_INLINE std::uint32_t meeting(const BlockBounds& bounds, std::uint32_t lane,
                                   const Shift& shift, const BlockBounds& lanes) const {
    const ChildBounds one{bounds.box, &bounds.slab, lane};
    return shift.none ? meeting_lanes(one, slabs_, lanes)
                      : meeting_lanes(MovedBounds{one, shift}, slabs_, lanes);
  }

  // The named children of one block against those of another. What is tested one by one is the
  // side that has fewer.
  HWY_NOINLINE void cross(std::uint32_t block_a, std::uint32_t in_a, std::uint32_t block_b,
                          std::uint32_t in_b) {
    ++scratch_.counters.block_pairs;
    const BlockBounds& bounds_a = bounds(bodies_.a, block_a, scratch_.arena);
    const BlockBounds& bounds_b = bounds(bodies_.b, block_b, scratch_.arena);
    if (std::popcount(in_a) <= std::popcount(in_b)) {
      for (std::uint32_t i : Bits(in_a))
        for (std::uint32_t j : Bits(in_b & meeting(bounds_a, i, to_b_, bounds_b)))
          meet({block_a, i, block_b, j});
    } else {
      for (std::uint32_t j : Bits(in_b))
        for (std::uint32_t i : Bits(in_a & meeting(bounds_b, j, to_a_, bounds_a)))
          meet({block_a, i, block_b, j});
    }
  }

  // Children of a below the slot that may meet the slot of b, and the other way round.
  HWY_NOINLINE std::uint32_t below_a(const SlotPair& slots) {
    const BlockBounds& above_b = bounds(bodies_.b, slots.block_b, scratch_.arena);
    const TreeChild a = child_a(slots.block_a, slots.lane_a);
    return meeting(above_b, slots.lane_b, to_a_, bounds(bodies_.a, a.index(), scratch_.arena));
  }
  HWY_NOINLINE std::uint32_t below_b(const SlotPair& slots) {
    const BlockBounds& above_a = bounds(bodies_.a, slots.block_a, scratch_.arena);
    const TreeChild b = child_b(slots.block_b, slots.lane_b);
    return meeting(above_a, slots.lane_a, to_b_, bounds(bodies_.b, b.index(), scratch_.arena));
  }

  HWY_NOINLINE void open(const SlotPair& slots) {
    const TreeChild a = child_a(slots.block_a, slots.lane_a);
    const TreeChild b = child_b(slots.block_b, slots.lane_b);
    if (a.leaf()) {
      for (std::uint32_t j : Bits(below_b(slots)))
        meet({slots.block_a, slots.lane_a, b.index(), j});
    } else if (b.leaf()) {
      for (std::uint32_t i : Bits(below_a(slots)))
        meet({a.index(), i, slots.block_b, slots.lane_b});
    } else {
      open_both(slots, a.index(), b.index());
    }
  }

  // Begins with the block whose bounds are known: the other may not be needed.
  void open_both(const SlotPair& slots, std::uint32_t a, std::uint32_t b) {
    std::uint32_t in_a = 0, in_b = 0;
    if (bodies_.b.blocks.find(b) != nullptr) {
      in_b = below_b(slots);
      if (in_b != 0) in_a = below_a(slots);
    } else {
      in_a = below_a(slots);
      if (in_a != 0) in_b = below_b(slots);
    }
    if (in_a != 0 && in_b != 0) cross(a, in_a, b, in_b);
  }

  HWY_INLINE void test_leaf_pairs() {
    for (const LeafPair& pair : scratch_.open.leaves) test_leaves(pair);
    scratch_.open.leaves.clear();
    flush();
  }

  // Triangles of one leaf, sixteen bits, whose boxes meet that of one triangle of the other.
  static HWY_INLINE std::uint32_t meeting_triangles(const LaneBoxes& box, std::uint32_t lane,
                                                    const Shift& shift, const LeafCache& leaf) {
    return overlapping_triangles(box, lane, shift, leaf.boxes[0]) |
           overlapping_triangles(box, lane, shift, leaf.boxes[1]) << kBlockWidth;
  }

  HWY_NOINLINE void test_leaves(const LeafPair& pair) {
    const LeafCache& a = map_leaf(bodies_.a, pair.a, scratch_.arena);
    const LeafCache& b = map_leaf(bodies_.b, pair.b, scratch_.arena);
    if (meeting_triangles(*a.whole, 0, to_b_, b) == 0) return;
    for (std::uint32_t i : Bits(meeting_triangles(*b.whole, 0, to_a_, a)))
      for (std::uint32_t j :
           Bits(meeting_triangles(a.boxes[i / kBlockWidth], i % kBlockWidth, to_b_, b)))
        add_pair(pair, a, i, b, j);
  }

  HWY_INLINE void add_pair(const LeafPair& leaves, const LeafCache& a, std::uint32_t i,
                           const LeafCache& b, std::uint32_t j) {
    TriangleBatch& batch = scratch_.batch;
    const std::size_t lane = batch.count;
    batch.a[lane] = name(bodies_.a, leaves.a, i);
    batch.b[lane] = name(bodies_.b, leaves.b, j);
    copy_corners(bodies_.a.tree->leaf_corners[leaves.a], a, i, batch.corner[0], lane);
    copy_corners(bodies_.b.tree->leaf_corners[leaves.b], b, j, batch.corner[1], lane);
    if (++batch.count == kBatchWidth) flush();
  }

  static std::uint32_t name(const LazyState& state, std::uint32_t leaf, std::uint32_t triangle) {
    return state.tree->leaf_triangles[state.tree->leaves[leaf].first_triangle + triangle];
  }

  static HWY_INLINE void copy_corners(const LeafCorners& corners, const LeafCache& leaf,
                                      std::uint32_t triangle, double (&out)[3][3][kBatchWidth],
                                      std::size_t lane) {
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = corners[c][triangle];
      out[c][0][lane] = leaf.x[v];
      out[c][1][lane] = leaf.y[v];
      out[c][2][lane] = leaf.z[v];
    }
  }

  HWY_NOINLINE void flush() {
    TriangleBatch& batch = scratch_.batch;
    if (batch.count == 0) return;
    const BatchVerdict verdict = test_batch(batch);
    std::uint32_t meeting = verdict.meet;
    for (std::uint32_t lane : Bits(verdict.unknown))
      if (triangles_intersect(batch.points(0, lane), batch.points(1, lane))) meeting |= 1u << lane;
    if (scratch_.candidates != nullptr)
      for (std::size_t lane = 0; lane < batch.count; ++lane)
        scratch_.candidates->push_back(
            {bodies_.names.a, bodies_.names.b, batch.a[lane], batch.b[lane]});
    scratch_.counters.triangle_tests += batch.count;
    scratch_.counters.filter_failures += static_cast<std::uint64_t>(std::popcount(verdict.unknown));
    for (std::uint32_t lane : Bits(meeting))
      out_.push_back({bodies_.names.a, bodies_.names.b, batch.a[lane], batch.b[lane]});
    batch.count = 0;
  }

  BodiesToTest bodies_;
  bool first_only_;
  LazyScratch& scratch_;
  std::vector<ElementPair>& out_;
  bool slabs_;
  Shift to_a_, to_b_;
};

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
