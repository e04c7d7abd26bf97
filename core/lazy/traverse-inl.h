// Two trees against each other, block by block, then leaf by leaf, then triangle by triangle.
// Compiled once per instruction set (kernels.cpp).

#if defined(CONTACTCHECK_LAZY_TRAVERSE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_TRAVERSE_INL
#undef CONTACTCHECK_LAZY_TRAVERSE_INL
#else
#define CONTACTCHECK_LAZY_TRAVERSE_INL
#endif

#include <hwy/highway.h>

#include <bit>
#include <cmath>

#include "core/lazy/kernels.h"
#include "core/lazy/leaves-inl.h"
#include "core/lazy/triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Takes boxes of one body's frame into the other's, outward.
struct Shift {
  float lo[3], hi[3];
  FrameBox apply(const FrameBox& box) const {
    FrameBox out;
    for (int k = 0; k < 3; ++k) {
      out.lo[k] = box.lo[k] + lo[k];
      out.hi[k] = box.hi[k] + hi[k];
    }
    return out;
  }
};

// From the frame of `from` to that of `to`. With u = 2^-24: the difference of the origins is wrong
// by 3 * 2^-53 of them, its float by u, and the sum in apply() rounds by u of its result. Bounds of
// `from` are at most 8 M < 16 (M <= 1 by the choice of the scale, 7 M with strays). Where this is
// not finite, nothing is excluded (by a finite number: empty lanes stay empty).
HWY_INLINE Shift shift_between(const LazyState& from, const LazyState& to) {
  constexpr double kUnit = 0x1p-24;
  Shift out;
  for (int k = 0; k < 3; ++k) {
    const double way = (from.origin[k] - to.origin[k]) * to.scale;
    const double origins = (std::abs(from.origin[k]) + std::abs(to.origin[k])) * to.scale;
    const double slack = 8 * 0x1p-53 * origins + 4 * kUnit * (std::abs(way) + 16.0);
    const bool sound = std::abs(way) + slack < 1e30;
    out.lo[k] = sound ? static_cast<float>(way - slack) : -1e38f;
    out.hi[k] = sound ? static_cast<float>(way + slack) : 1e38f;
  }
  return out;
}

HWY_INLINE FrameBox box_of_lane(const LaneBoxes& boxes, std::uint32_t lane) {
  FrameBox out;
  for (int k = 0; k < 3; ++k) {
    out.lo[k] = boxes.lo[k][lane];
    out.hi[k] = boxes.hi[k][lane];
  }
  return out;
}

// Bit i: lane i shares a point with `box`.
HWY_INLINE std::uint32_t overlapping(const FrameBox& box, const LaneBoxes& lanes) {
  const FloatLanes d;
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
    auto hit = hn::Le(hn::Load(d, lanes.lo[0] + i), hn::Set(d, box.hi[0]));
    hit = hn::And(hit, hn::Le(hn::Set(d, box.lo[0]), hn::Load(d, lanes.hi[0] + i)));
    for (int k = 1; k < 3; ++k) {
      hit = hn::And(hit, hn::Le(hn::Load(d, lanes.lo[k] + i), hn::Set(d, box.hi[k])));
      hit = hn::And(hit, hn::Le(hn::Set(d, box.lo[k]), hn::Load(d, lanes.hi[k] + i)));
    }
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hit, bits);
    out |= static_cast<std::uint32_t>(bits[0]) << i;
  }
  return out;
}

class PairTraversal {
 public:
  PairTraversal(BodiesToTest bodies, bool first_only, LazyScratch& scratch,
                std::vector<ElementPair>& out)
      : bodies_(bodies),
        first_only_(first_only),
        scratch_(scratch),
        out_(out),
        to_a_(shift_between(bodies.b, bodies.a)),
        to_b_(shift_between(bodies.a, bodies.b)) {}

  HWY_INLINE void run() {
    scratch_.stack.clear();
    scratch_.leaf_pairs.clear();
    scratch_.batch.count = 0;
    const std::size_t before = out_.size();
    cross(0, 0xff, 0);
    while (!scratch_.stack.empty()) {
      const SlotPair slots = scratch_.stack.back();
      scratch_.stack.pop_back();
      open(slots);
      if (!first_only_ || scratch_.leaf_pairs.size() < kLeafPairsAtOnce) continue;
      test_leaf_pairs();
      if (out_.size() > before) break;
    }
    if (first_only_ && out_.size() > before) {
      out_.resize(before + 1);
      return;
    }
    test_leaf_pairs();
    if (first_only_ && out_.size() > before) out_.resize(before + 1);
  }

 private:
  static constexpr std::size_t kLeafPairsAtOnce = 16;

  TreeChild child_a(std::uint32_t block, std::uint32_t lane) const {
    return bodies_.a.tree->blocks[block].child[lane];
  }
  TreeChild child_b(std::uint32_t block, std::uint32_t lane) const {
    return bodies_.b.tree->blocks[block].child[lane];
  }

  HWY_INLINE void meet(const SlotPair& slots) {
    const TreeChild a = child_a(slots.block_a, slots.lane_a);
    const TreeChild b = child_b(slots.block_b, slots.lane_b);
    if (a.leaf() && b.leaf()) {
      scratch_.leaf_pairs.push_back({a.index(), b.index()});
      ++scratch_.counters.leaf_pairs;
    } else {
      scratch_.stack.push_back(slots);
    }
  }

  // All children of one block, as far as `lanes` says, against those of another.
  HWY_INLINE void cross(std::uint32_t block_a, std::uint32_t lanes, std::uint32_t block_b) {
    ++scratch_.counters.block_pairs;
    const LaneBoxes& boxes_a = bounds(bodies_.a, block_a, scratch_.counters);
    const LaneBoxes& boxes_b = bounds(bodies_.b, block_b, scratch_.counters);
    lanes &= (1u << bodies_.a.tree->blocks[block_a].children) - 1;
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(lanes));
      std::uint32_t hits = overlapping(to_b_.apply(box_of_lane(boxes_a, i)), boxes_b);
      for (; hits != 0; hits &= hits - 1)
        meet({block_a, i, block_b, static_cast<std::uint32_t>(std::countr_zero(hits))});
    }
  }

  HWY_INLINE void open(const SlotPair& slots) {
    const TreeChild a = child_a(slots.block_a, slots.lane_a);
    const TreeChild b = child_b(slots.block_b, slots.lane_b);
    const FrameBox box_a = box_of_lane(bodies_.a.block_boxes[slots.block_a], slots.lane_a);
    const FrameBox box_b = box_of_lane(bodies_.b.block_boxes[slots.block_b], slots.lane_b);
    if (!a.leaf() && !b.leaf()) {
      const LaneBoxes& boxes = bounds(bodies_.a, a.index(), scratch_.counters);
      cross(a.index(), overlapping(to_a_.apply(box_b), boxes), b.index());
    } else if (a.leaf()) {
      const LaneBoxes& boxes = bounds(bodies_.b, b.index(), scratch_.counters);
      std::uint32_t hits = overlapping(to_b_.apply(box_a), boxes);
      for (; hits != 0; hits &= hits - 1)
        meet({slots.block_a, slots.lane_a, b.index(),
              static_cast<std::uint32_t>(std::countr_zero(hits))});
    } else {
      const LaneBoxes& boxes = bounds(bodies_.a, a.index(), scratch_.counters);
      std::uint32_t hits = overlapping(to_a_.apply(box_b), boxes);
      for (; hits != 0; hits &= hits - 1)
        meet({a.index(), static_cast<std::uint32_t>(std::countr_zero(hits)), slots.block_b,
              slots.lane_b});
    }
  }

  HWY_INLINE void test_leaf_pairs() {
    for (const LeafPair& pair : scratch_.leaf_pairs) test_leaves(pair);
    scratch_.leaf_pairs.clear();
    flush();
  }

  HWY_INLINE void test_leaves(const LeafPair& pair) {
    const LeafCache& a = map_leaf(bodies_.a, pair.a, scratch_.counters);
    const LeafCache& b = map_leaf(bodies_.b, pair.b, scratch_.counters);
    const FrameBox whole_b = to_a_.apply(b.box), whole_a = to_b_.apply(a.box);
    const std::uint32_t in_b = overlapping(whole_a, b.boxes[0]) | overlapping(whole_a, b.boxes[1])
                                                                      << kBlockWidth;
    if (in_b == 0) return;
    for (std::uint32_t half = 0; half < 2; ++half) {
      std::uint32_t in_a = overlapping(whole_b, a.boxes[half]);
      for (; in_a != 0; in_a &= in_a - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(in_a));
        const FrameBox box = to_b_.apply(box_of_lane(a.boxes[half], i));
        std::uint32_t hits = overlapping(box, b.boxes[0]) | overlapping(box, b.boxes[1])
                                                                << kBlockWidth;
        for (hits &= in_b; hits != 0; hits &= hits - 1)
          add_pair(pair, a, half * kBlockWidth + i, b,
                   static_cast<std::uint32_t>(std::countr_zero(hits)));
      }
    }
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

  HWY_INLINE void flush() {
    TriangleBatch& batch = scratch_.batch;
    if (batch.count == 0) return;
    const BatchVerdict verdict = test_batch(batch);
    std::uint32_t meeting = verdict.meet;
    for (std::uint32_t left = verdict.unknown; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      if (triangles_intersect(batch.points(0, lane), batch.points(1, lane))) meeting |= 1u << lane;
    }
    if (scratch_.candidates != nullptr)
      for (std::size_t lane = 0; lane < batch.count; ++lane)
        scratch_.candidates->push_back(
            {bodies_.names.a, bodies_.names.b, batch.a[lane], batch.b[lane]});
    scratch_.counters.triangle_tests += batch.count;
    scratch_.counters.filter_failures += static_cast<std::uint64_t>(std::popcount(verdict.unknown));
    for (; meeting != 0; meeting &= meeting - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(meeting));
      out_.push_back({bodies_.names.a, bodies_.names.b, batch.a[lane], batch.b[lane]});
    }
    batch.count = 0;
  }

  BodiesToTest bodies_;
  bool first_only_;
  LazyScratch& scratch_;
  std::vector<ElementPair>& out_;
  Shift to_a_, to_b_;
};

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
