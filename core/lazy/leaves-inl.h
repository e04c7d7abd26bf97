// Mapped leaves: the canonical vertices of up to sixteen triangles and the triangles' boxes.
// Compiled once per instruction set (kernels.cpp).

#if defined(CONTACTCHECK_LAZY_LEAVES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_LEAVES_INL
#undef CONTACTCHECK_LAZY_LEAVES_INL
#else
#define CONTACTCHECK_LAZY_LEAVES_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <new>

#include "core/deform/mapping-inl.h"
#include "core/lazy/bounds-inl.h"
#include "core/lazy/lazy_state.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DoubleLanes = hn::CappedTag<double, kBlockWidth>;

// The last vector of a run writes beyond it: the next run overwrites that, or it is padding.
HWY_INLINE void map_runs(const LazyState& state, const TreeLeaf& leaf, double* (&out)[3]) {
  const DoubleLanes d;
  const LatticeTree& tree = *state.tree;
  std::uint32_t done = 0;
  for (std::uint32_t r = 0; r < leaf.runs; ++r) {
    const VertexRun run = tree.runs[leaf.first_run + r];
    double corners[3][8];
    gather_corners(state.shape->lattice->cell_nodes[run.cell], state.nodes.data(), corners);
    for (std::uint32_t i = 0; i < run.count; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
      const std::size_t at = leaf.first_vertex + done + i;
      const auto w =
          local_lanes(d, hn::LoadU(d, &tree.leaf_local[0][at]),
                      hn::LoadU(d, &tree.leaf_local[1][at]), hn::LoadU(d, &tree.leaf_local[2][at]));
      for (int k = 0; k < 3; ++k) hn::StoreU(map_axis(d, corners[k], w), d, out[k] + done + i);
    }
    done += run.count;
  }
}

HWY_INLINE void copy_vertices(const LazyState& state, const TreeLeaf& leaf, double* (&out)[3]) {
  for (std::uint32_t i = 0; i < leaf.vertices; ++i) {
    const Vec3& v = state.vertices[state.tree->leaf_vertices[leaf.first_vertex + i]];
    for (int k = 0; k < 3; ++k) out[k][i] = v[k];
  }
}

// One coordinate of all vertices as floats in the body's frame.
HWY_INLINE void to_frame(const double* x, double origin, double scale, std::uint32_t count,
                         float* out) {
  const DoubleLanes d;
  const hn::Rebind<float, DoubleLanes> df;
  const auto from = hn::Set(d, origin), by = hn::Set(d, scale);
  for (std::uint32_t i = 0; i < count; i += static_cast<std::uint32_t>(hn::Lanes(d)))
    hn::StoreU(hn::DemoteTo(df, hn::Mul(hn::Sub(hn::LoadU(d, x + i), from), by)), df, out + i);
}

// Bounds along one axis of the triangles of eight lanes; lanes from `count` on become empty.
HWY_INLINE void bound_triangles(const float* x, const LeafCorners& corners, std::uint32_t first,
                                std::uint32_t count, float slack, float* lo, float* hi) {
  const FloatLanes d;
  const hn::Rebind<std::uint8_t, FloatLanes> d8;
  const hn::Rebind<std::int32_t, FloatLanes> d32;
  const auto none = hn::Set(d, kInfinity);
  for (std::size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
    const auto corner = [&](int k) HWY_ATTR {
      const auto ids = hn::PromoteTo(d32, hn::LoadU(d8, corners[k].data() + first + i));
      return hn::GatherIndex(d, x, ids);
    };
    const auto a = corner(0), b = corner(1), c = corner(2);
    const auto present = hn::FirstN(d, count > first + i ? count - first - i : 0);
    const auto least = hn::Sub(hn::Min(hn::Min(a, b), c), hn::Set(d, slack));
    const auto most = hn::Add(hn::Max(hn::Max(a, b), c), hn::Set(d, slack));
    hn::Store(hn::IfThenElse(present, least, none), d, lo + i);
    hn::Store(hn::IfThenElse(present, most, hn::Neg(none)), d, hi + i);
  }
}

// The least (or largest) of eight lanes.
template <bool least>
HWY_INLINE float extreme(const float* lanes) {
  const FloatLanes d;
  auto best = hn::Load(d, lanes);
  for (std::size_t i = hn::Lanes(d); i < kBlockWidth; i += hn::Lanes(d))
    best = least ? hn::Min(best, hn::Load(d, lanes + i)) : hn::Max(best, hn::Load(d, lanes + i));
  return hn::GetLane(least ? hn::MinOfLanes(d, best) : hn::MaxOfLanes(d, best));
}

HWY_INLINE const LeafCache& map_leaf(LazyState& state, std::uint32_t index, FrameArena& arena) {
  static_assert(kLeafTriangles == 2 * kBlockWidth);
  if (const LeafCache* known = state.leaves.find(index)) return *known;
  const TreeLeaf& leaf = state.tree->leaves[index];
  const std::size_t room = (leaf.vertices + kLeafPadding + 7u) / 8 * 8;
  auto* const world = static_cast<double*>(
      arena.take(3 * room * sizeof(double) + 3 * sizeof(LaneBoxes) + sizeof(LeafCache)));
  double* axes[3] = {world, world + room, world + 2 * room};
  if (state.from_vertices) {
    copy_vertices(state, leaf, axes);
  } else {
    map_runs(state, leaf, axes);
  }
  auto* const boxes = reinterpret_cast<LaneBoxes*>(world + 3 * room);
  LeafCache& cache = *new (boxes + 3) LeafCache;
  HWY_ALIGN float near[3 * kLeafTriangles + kBlockWidth];
  for (int k = 0; k < 3; ++k) {
    to_frame(axes[k], state.origin[k], state.scale, leaf.vertices, near);
    for (std::uint32_t half = 0; half < 2; ++half)
      bound_triangles(near, state.tree->leaf_corners[index], half * kBlockWidth, leaf.triangles,
                      state.slack, boxes[half].lo[k], boxes[half].hi[k]);
    boxes[2].lo[k][0] = std::min(extreme<true>(boxes[0].lo[k]), extreme<true>(boxes[1].lo[k]));
    boxes[2].hi[k][0] = std::max(extreme<false>(boxes[0].hi[k]), extreme<false>(boxes[1].hi[k]));
  }
  cache.x = axes[0], cache.y = axes[1], cache.z = axes[2];
  cache.boxes = boxes, cache.whole = boxes + 2;
  state.leaves.put(index, &cache);
  return cache;
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
