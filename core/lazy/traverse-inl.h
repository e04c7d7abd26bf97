// Two trees against each other, block by block down to pairs of leaves.
// Compiled once per instruction set (kernels.cpp).

#if defined(CONTACTCHECK_LAZY_TRAVERSE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_TRAVERSE_INL
#undef CONTACTCHECK_LAZY_TRAVERSE_INL
#else
#define CONTACTCHECK_LAZY_TRAVERSE_INL
#endif

#include <hwy/highway.h>

#include <bit>

#include "core/lazy/embedded_patch.h"
#include "core/lazy/kernels.h"
#include "core/lazy/leaf_pairs-inl.h"
#include "core/lazy/meeting-inl.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Steps are calls: inlined into one another they would be compiled a hundred times.
class PairTraversal {
 public:
  PairTraversal(BodiesToTest bodies, bool first_only, LazyScratch& scratch,
                std::vector<ElementPair>& out)
      : bodies_(bodies),
        first_only_(first_only),
        scratch_(scratch),
        out_(out),
        patches_(&bodies.a == &bodies.b && bodies.a.end == nullptr ? bodies.a.patches : nullptr),
        slabs_(!bodies.a.from_vertices && !bodies.b.from_vertices),
        to_a_(translation_between(bodies.b, bodies.a)),
        to_b_(translation_between(bodies.a, bodies.b)) {
    scratch.open.slots.clear();
    scratch.open.leaves.clear();
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

  /// Tests one body with itself: any two triangles are below two children of a block, or in a leaf.
  HWY_INLINE void run_self() {
    std::vector<std::uint32_t>& own = scratch_.own_blocks;
    own.assign(1, 0);
    while (!own.empty()) {
      const std::uint32_t block = own.back();
      own.pop_back();
      cross_with_itself(block);
    }
    finish();
  }

  HWY_INLINE void spread(std::size_t slots, BvttFront& front) {
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

  bool stay_embedded(std::uint32_t block_a, std::uint32_t lane_a, std::uint32_t block_b,
                     std::uint32_t lane_b) const {
    return patches_ != nullptr &&
           stays_embedded(bodies_.a, *patches_, block_a * kBlockWidth + lane_a,
                          block_b * kBlockWidth + lane_b);
  }

  HWY_INLINE void meet(const SlotPair& slots) {
    if (stay_embedded(slots.block_a, slots.lane_a, slots.block_b, slots.lane_b)) return;
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
                                   const Translation& translation, const BlockBounds& lanes) const {
    const ChildBounds one{bounds.box, &bounds.slab, lane};
    return translation.none ? meeting_lanes(one, slabs_, lanes)
                            : meeting_lanes(MovedBounds{one, translation}, slabs_, lanes);
  }

  // Tests children of one block, bits `in_a`, against those of another, bits `in_b`. Loops over the
  // side with fewer.
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

  HWY_NOINLINE void cross_with_itself(std::uint32_t block) {
    ++scratch_.counters.block_pairs;
    const TreeBlock& children = bodies_.a.tree->blocks[block];
    const BlockBounds& all = bounds(bodies_.a, block, scratch_.arena);
    for (std::uint32_t i = 0; i < children.children; ++i) {
      const TreeChild child = children.child[i];
      if (stay_embedded(block, i, block, i)) {
        // nothing below it meets
      } else if (child.leaf()) {
        scratch_.open.leaves.push_back({child.index(), child.index()});
        ++scratch_.counters.leaf_pairs;
      } else {
        scratch_.own_blocks.push_back(child.index());
      }
      const std::uint32_t later = ((1u << children.children) - 1) & ~((2u << i) - 1);
      for (std::uint32_t j : Bits(later & meeting(all, i, to_b_, all))) meet({block, i, block, j});
    }
  }

  // Bits of the children below slot a that may meet slot b; below_b: the other way round.
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

  // Begins with the block whose bounds are cached: the other's may not be needed.
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

  // Blocks are bounded in floats in both precisions, so the precision matters here first.
  HWY_NOINLINE void test_leaf_pairs() {
    if (bodies_.a.precision == Precision::kSingle) {
      test_leaf_pairs_in<float>();
    } else {
      test_leaf_pairs_in<double>();
    }
    scratch_.open.leaves.clear();
  }

  template <class Real>
  HWY_INLINE void test_leaf_pairs_in() {
    LeafPairTests<Real> tests(bodies_, to_a_, to_b_, scratch_, out_);
    for (const LeafPair& pair : scratch_.open.leaves) tests.test(pair);
    tests.flush();
  }

  BodiesToTest bodies_;
  bool first_only_;
  LazyScratch& scratch_;
  std::vector<ElementPair>& out_;
  const PatchTree* patches_;  // null, except for self-contact
  bool slabs_;
  Translation to_a_, to_b_;
};

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
