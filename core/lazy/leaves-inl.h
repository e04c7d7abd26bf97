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

HWY_INLINE const double* leaf_local(double, const LatticeTree& tree, int axis) {
  return tree.leaf_local[axis].data();
}
HWY_INLINE const float* leaf_local(float, const LatticeTree& tree, int axis) {
  return tree.single_leaf_local[axis].data();
}

// The last vector of a run writes beyond it: the next run overwrites that, or it is padding.
template <class Real>
HWY_INLINE void map_runs(const LazyState& state, const TreeLeaf& leaf, Real* (&out)[3]) {
  const hn::CappedTag<Real, kBlockWidth> d;
  const LatticeTree& tree = *state.tree;
  const Real* local[3];
  for (int k = 0; k < 3; ++k) local[k] = leaf_local(Real(), tree, k) + leaf.first_vertex;
  std::uint32_t done = 0;
  for (std::uint32_t r = 0; r < leaf.runs; ++r) {
    const VertexRun run = tree.runs[leaf.first_run + r];
    Real corners[3][8];
    gather_corners(state.shape->lattice->cell_nodes[run.cell], nodes_in<Real>(state).data(),
                   corners);
    for (std::uint32_t i = 0; i < run.count; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
      const std::uint32_t at = done + i;
      const auto w = local_lanes(d, hn::LoadU(d, local[0] + at), hn::LoadU(d, local[1] + at),
                                 hn::LoadU(d, local[2] + at));
      for (int k = 0; k < 3; ++k) hn::StoreU(map_axis(d, corners[k], w), d, out[k] + at);
    }
    done += run.count;
  }
}

template <class Real>
HWY_INLINE void copy_vertices(const LazyState& state, const TreeLeaf& leaf, Real* (&out)[3]) {
  const auto vertices = vertices_in<Real>(state);
  for (std::uint32_t i = 0; i < leaf.vertices; ++i) {
    const Vec3Of<Real>& v = vertices[state.tree->leaf_vertices[leaf.first_vertex + i]];
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

// Boxes of a leaf's triangles, and of the whole leaf, along one axis. `near`: in the body's frame.
HWY_INLINE void bound_leaf(const float* near, const LeafCorners& corners, std::uint32_t triangles,
                           float slack, int axis, LaneBoxes* boxes) {
  for (std::uint32_t half = 0; half < 2; ++half)
    bound_triangles(near, corners, half * kBlockWidth, triangles, slack, boxes[half].lo[axis],
                    boxes[half].hi[axis]);
  boxes[2].lo[axis][0] =
      std::min(extreme<true>(boxes[0].lo[axis]), extreme<true>(boxes[1].lo[axis]));
  boxes[2].hi[axis][0] =
      std::max(extreme<false>(boxes[0].hi[axis]), extreme<false>(boxes[1].hi[axis]));
}

// Floats are in the body's frame: their boxes need no slack.
HWY_INLINE void bound_axis(const LazyState& state, std::uint32_t index, const float* x, int axis,
                           LaneBoxes* boxes) {
  bound_leaf(x, state.tree->leaf_corners[index], state.tree->leaves[index].triangles, 0.0f, axis,
             boxes);
}

HWY_INLINE void bound_axis(const LazyState& state, std::uint32_t index, const double* x, int axis,
                           LaneBoxes* boxes) {
  const TreeLeaf& leaf = state.tree->leaves[index];
  HWY_ALIGN float near[3 * kLeafTriangles + kBlockWidth];
  to_frame(x, state.origin[axis], state.scale, leaf.vertices, near);
  bound_leaf(near, state.tree->leaf_corners[index], leaf.triangles, state.slack, axis, boxes);
}

template <class Real>
HWY_INLINE void fill_vertices(const LazyState& state, const TreeLeaf& leaf, Real* (&out)[3]) {
  if (state.from_vertices) {
    copy_vertices(state, leaf, out);
  } else {
    map_runs(state, leaf, out);
  }
}

// Joins the boxes of a leaf's triangles at the end of a step to those at its start.
template <class Real>
HWY_NOINLINE void join_leaf_end(const LazyState& end, std::uint32_t index, LaneBoxes* boxes) {
  HWY_ALIGN Real ends[3][3 * kLeafTriangles + 2 * kLeafPadding];
  Real* axes[3] = {ends[0], ends[1], ends[2]};
  fill_vertices(end, end.tree->leaves[index], axes);
  LaneBoxes later[3];
  for (int k = 0; k < 3; ++k) {
    bound_axis(end, index, axes[k], k, later);
    for (std::size_t box = 0; box < 3; ++box)
      for (std::size_t lane = 0; lane < (box == 2 ? 1 : kBlockWidth); ++lane) {
        boxes[box].lo[k][lane] = std::min(boxes[box].lo[k][lane], later[box].lo[k][lane]);
        boxes[box].hi[k][lane] = std::max(boxes[box].hi[k][lane], later[box].hi[k][lane]);
      }
  }
}

template <class Real>
HWY_NOINLINE const LeafCacheOf<Real>& make_leaf(LazyState& state, std::uint32_t index,
                                                FrameArena& arena) {
  static_assert(kLeafTriangles == 2 * kBlockWidth);
  const TreeLeaf& leaf = state.tree->leaves[index];
  constexpr std::size_t kLine = 64 / sizeof(Real);  // boxes follow, aligned
  const std::size_t room = (leaf.vertices + kLeafPadding + kLine - 1) / kLine * kLine;
  auto* const mapped = static_cast<Real*>(
      arena.take(3 * room * sizeof(Real) + 3 * sizeof(LaneBoxes) + sizeof(LeafCacheOf<Real>)));
  Real* axes[3] = {mapped, mapped + room, mapped + 2 * room};
  fill_vertices(state, leaf, axes);
  auto* const boxes = reinterpret_cast<LaneBoxes*>(mapped + 3 * room);
  auto& cache = *new (boxes + 3) LeafCacheOf<Real>;
  for (int k = 0; k < 3; ++k) bound_axis(state, index, axes[k], k, boxes);
  if (state.end != nullptr) join_leaf_end<Real>(*state.end, index, boxes);
  cache.x = axes[0], cache.y = axes[1], cache.z = axes[2];
  cache.boxes = boxes, cache.whole = boxes + 2;
  leaves_in<Real>(state).put(index, &cache);
  return cache;
}

template <class Real>
HWY_INLINE const LeafCacheOf<Real>& map_leaf_in(LazyState& state, std::uint32_t index,
                                                FrameArena& arena) {
  if (const LeafCacheOf<Real>* known = leaves_in<Real>(state).find(index)) return *known;
  return make_leaf<Real>(state, index, arena);
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
