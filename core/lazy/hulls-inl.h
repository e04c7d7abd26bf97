// Boxes of children bounded by hulls of lattice nodes (lattice_tree.h has the derivation,
// bounds-inl.h that of the slack). Compiled once per instruction set (kernels.cpp).

#if defined(CONTACTCHECK_LAZY_HULLS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_HULLS_INL
#undef CONTACTCHECK_LAZY_HULLS_INL
#else
#define CONTACTCHECK_LAZY_HULLS_INL
#endif

#include <hwy/highway.h>

#include <limits>

#include "core/lazy/lazy_state.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A point as four floats, however many fit a vector.
using PointLanes = hn::CappedTag<float, 4>;
constexpr std::size_t kPointParts = 4 / hn::MaxLanes(PointLanes());

struct Point {
  hn::Vec<PointLanes> part[kPointParts];
};

template <class Operation>
HWY_INLINE Point per_part(const Point& a, const Point& b, Operation&& operation) {
  Point out;
  for (std::size_t i = 0; i < kPointParts; ++i) out.part[i] = operation(a.part[i], b.part[i]);
  return out;
}

HWY_INLINE Point least_of(const Point& a, const Point& b) {
  return per_part(a, b, [](auto x, auto y) HWY_ATTR { return hn::Min(x, y); });
}
HWY_INLINE Point most_of(const Point& a, const Point& b) {
  return per_part(a, b, [](auto x, auto y) HWY_ATTR { return hn::Max(x, y); });
}
HWY_INLINE Point sum_of(const Point& a, const Point& b) {
  return per_part(a, b, [](auto x, auto y) HWY_ATTR { return hn::Add(x, y); });
}
HWY_INLINE Point difference_of(const Point& a, const Point& b) {
  return per_part(a, b, [](auto x, auto y) HWY_ATTR { return hn::Sub(x, y); });
}
HWY_INLINE Point product_of(const Point& a, const Point& b) {
  return per_part(a, b, [](auto x, auto y) HWY_ATTR { return hn::Mul(x, y); });
}
HWY_INLINE Point all_equal(float value) {
  Point out;
  for (auto& part : out.part) part = hn::Set(PointLanes(), value);
  return out;
}
HWY_INLINE Point load_point(const float* from) {
  Point out;
  for (std::size_t i = 0; i < kPointParts; ++i)
    out.part[i] = hn::Load(PointLanes(), from + i * hn::MaxLanes(PointLanes()));
  return out;
}
HWY_INLINE void store_point(const Point& p, float* to) {
  for (std::size_t i = 0; i < kPointParts; ++i)
    hn::Store(p.part[i], PointLanes(), to + i * hn::MaxLanes(PointLanes()));
}

HWY_INLINE Point node(const LazyState& state, std::uint32_t id) {
  return load_point(state.near_nodes[id].v);
}

struct PointRange {
  Point lo, hi;
};

HWY_INLINE PointRange no_points() {
  return {all_equal(std::numeric_limits<float>::infinity()),
          all_equal(-std::numeric_limits<float>::infinity())};
}

HWY_INLINE void include(PointRange& range, const Point& p) {
  range.lo = least_of(range.lo, p);
  range.hi = most_of(range.hi, p);
}

HWY_INLINE PointRange bound_hull(const LazyState& state, const HullChild& hull) {
  PointRange all = no_points();
  for (std::uint32_t n = hull.node_begin; n < hull.node_end; ++n)
    include(all, node(state, state.tree->hull_nodes[n]));
  Point wide = all_equal(state.slack);
  for (int k = 0; k < 3; ++k)
    wide = sum_of(wide, product_of(all_equal(hull.reach[k]), load_point(state.longest_edge[k].v)));
  all.lo = difference_of(all.lo, wide);
  all.hi = sum_of(all.hi, wide);
  return all;
}

HWY_NOINLINE void bound_hulls(const LazyState& state, const TreeBlock& block, LaneBoxes& out) {
  for (std::uint32_t c = 0; c < kBlockWidth; ++c) {
    PointRange range = no_points();
    if (c < block.children) range = bound_hull(state, state.tree->hulls[block.begin + c]);
    HWY_ALIGN float ends[2][4];
    store_point(range.lo, ends[0]);
    store_point(range.hi, ends[1]);
    for (int k = 0; k < 3; ++k) {
      out.lo[k][c] = ends[0][k];
      out.hi[k][c] = ends[1][k];
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
