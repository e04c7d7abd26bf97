// Triangles of two leaves against each other: boxes, then the test of triangles in batches. Over a
// step the pairs whose boxes overlap are candidates, which others test.
// Compiled once per instruction set (kernels.cpp).

#if defined(CONTACTCHECK_LAZY_LEAF_PAIRS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_LEAF_PAIRS_INL
#undef CONTACTCHECK_LAZY_LEAF_PAIRS_INL
#else
#define CONTACTCHECK_LAZY_LEAF_PAIRS_INL
#endif

#include <hwy/highway.h>

#include <bit>

#include "core/lazy/kernels.h"
#include "core/lazy/leaves-inl.h"
#include "core/lazy/meeting-inl.h"
#include "core/lazy/triangles-inl.h"
#include "core/narrow/adjacent_triangles.h"
#include "core/types/shared_corners.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Bit i: the box of a leaf, or of one of its triangles, overlaps box i of the other body's
// triangles.
HWY_INLINE std::uint32_t overlapping_triangles(const LaneBoxes& box, std::uint32_t lane,
                                               const Translation& translation,
                                               const LaneBoxes& lanes) {
  const ChildBounds one{box, nullptr, lane};
  return translation.none ? overlapping(one, lanes)
                          : overlapping(MovedBounds{one, translation}, lanes);
}

HWY_INLINE TriangleBatchSet<double>& batches_in(double, LazyScratch& scratch) {
  return scratch.batches;
}
HWY_INLINE TriangleBatchSet<float>& batches_in(float, LazyScratch& scratch) {
  return scratch.single_batches;
}

// Tests of leaf pairs of two bodies; flush() when all are in.
template <class Real>
class LeafPairTests {
 public:
  LeafPairTests(const BodiesToTest& bodies, const Translation& to_a, const Translation& to_b,
                LazyScratch& scratch, std::vector<ElementPair>& out)
      : bodies_(bodies),
        to_a_(to_a),
        to_b_(to_b),
        scratch_(scratch),
        batches_(batches_in(Real(), scratch)),
        own_(&bodies.a == &bodies.b),
        collects_(bodies.a.end != nullptr),
        out_(out) {
    for (TriangleBatchOf<Real>& batch : batches_.of) batch.count = 0;
  }

  HWY_NOINLINE void test(const LeafPair& pair) {
    const Leaf& a = map_leaf_in<Real>(bodies_.a, pair.a, scratch_.arena);
    const Leaf& b = map_leaf_in<Real>(bodies_.b, pair.b, scratch_.arena);
    const std::uint32_t in_b = meeting_triangles(*a.whole, 0, to_b_, b);
    if (in_b == 0) return;
    const std::uint32_t in_a = meeting_triangles(*b.whole, 0, to_a_, a);
    // Loops over the side with fewer triangles.
    if (own_ && pair.a == pair.b) {
      for (std::uint32_t i : Bits(in_a))
        for (std::uint32_t j : Bits(in_b & partners(a, i, to_b_, b) & ~((2u << i) - 1)))
          add_pair(pair, a, i, b, j);
    } else if (std::popcount(in_a) <= std::popcount(in_b)) {
      for (std::uint32_t i : Bits(in_a))
        for (std::uint32_t j : Bits(in_b & partners(a, i, to_b_, b))) add_pair(pair, a, i, b, j);
    } else {
      for (std::uint32_t j : Bits(in_b))
        for (std::uint32_t i : Bits(in_a & partners(b, j, to_a_, a))) add_pair(pair, a, i, b, j);
    }
  }

  HWY_NOINLINE void flush() {
    for (TriangleBatchOf<Real>& batch : batches_.of) flush(batch);
  }

 private:
  using Leaf = LeafCacheOf<Real>;

  // Bit i, of sixteen: the box of triangle i of `leaf` overlaps lane `lane` of `box`.
  static HWY_INLINE std::uint32_t meeting_triangles(const LaneBoxes& box, std::uint32_t lane,
                                                    const Translation& translation,
                                                    const Leaf& leaf) {
    return overlapping_triangles(box, lane, translation, leaf.boxes[0]) |
           overlapping_triangles(box, lane, translation, leaf.boxes[1]) << kBlockWidth;
  }

  // Triangles of `other` whose boxes overlap that of triangle i of `leaf`, as bits.
  static HWY_INLINE std::uint32_t partners(const Leaf& leaf, std::uint32_t i,
                                           const Translation& translation, const Leaf& other) {
    return meeting_triangles(leaf.boxes[i / kBlockWidth], i % kBlockWidth, translation, other);
  }

  HWY_NOINLINE void flush(TriangleBatchOf<Real>& batch) {
    if (batch.count == 0) return;
    const BatchVerdict verdict = test_batch_in(batch);
    std::uint32_t meeting = verdict.meet;
    for (std::uint32_t lane : Bits(verdict.unknown))
      if (batch.meets(lane)) meeting |= 1u << lane;
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

  HWY_INLINE void add_pair(const LeafPair& leaves, const Leaf& a, std::uint32_t i, const Leaf& b,
                           std::uint32_t j) {
    const std::uint32_t s = name(bodies_.a, leaves.a, i), t = name(bodies_.b, leaves.b, j);
    if (collects_) {
      out_.push_back({bodies_.names.a, bodies_.names.b, s, t});
      return;
    }
    SharedCorners shared;
    if (own_) {
      const std::vector<Triangle>& linked = bodies_.a.shape->linked();
      shared = shared_corners(linked[s], linked[t]);
      if (shared.duplicates) return;
    }
    TriangleBatchOf<Real>& batch = batches_.of[shared.count];
    const std::size_t lane = batch.count;
    batch.a[lane] = s;
    batch.b[lane] = t;
    copy_corners(bodies_.a.tree->leaf_corners[leaves.a], a, i, shared.p, batch.corner[0], lane);
    copy_corners(bodies_.b.tree->leaf_corners[leaves.b], b, j, shared.q, batch.corner[1], lane);
    if (++batch.count == kBatchWidth) flush(batch);
  }

  static std::uint32_t name(const LazyState& state, std::uint32_t leaf, std::uint32_t triangle) {
    return state.tree->leaf_triangles[state.tree->leaves[leaf].first_triangle + triangle];
  }

  static HWY_INLINE void copy_corners(const LeafCorners& corners, const Leaf& leaf,
                                      std::uint32_t triangle,
                                      const std::array<std::uint8_t, 3>& order,
                                      Real (&out)[3][3][kBatchWidth], std::size_t lane) {
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = corners[order[c]][triangle];
      out[c][0][lane] = leaf.x[v];
      out[c][1][lane] = leaf.y[v];
      out[c][2][lane] = leaf.z[v];
    }
  }

  const BodiesToTest& bodies_;
  const Translation& to_a_;
  const Translation& to_b_;
  LazyScratch& scratch_;
  TriangleBatchSet<Real>& batches_;
  bool own_;       ///< both leaves are of one body
  bool collects_;  ///< pairs are candidates over a step
  std::vector<ElementPair>& out_;
};

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
