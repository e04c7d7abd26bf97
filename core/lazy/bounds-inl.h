// Bounds of the eight children of a block, from deformed lattice nodes. Compiled once per
// instruction set (kernels.cpp).
//
// Slack. Let u = 2^-24 and M the largest |coordinate| of the body's nodes in its own frame, where
// all values of a hull lie. A node's float is wrong by u M (and by the rounding of x - origin in
// double, below). A blend b + s (c - b) of two values wrong by e each adds 2 u M for the
// difference, 2 u M for the product (none where it is fused) and u M for the sum: 5 u M. Three
// nested blends: 16 u M in all. A stray's edge is wrong by 2 u M for its nodes and 2 u M for the
// difference, its product with the reach by another 2 u M; three axes: 18 u M, and three sums of
// values up to 7 M: 21 u M. Pushing a box outward rounds once more, at 8 M. Below 50 u M in all,
// to first order; 64 u M is the slack. To it come, in units of the world, the error of the
// canonical mapping (mapping.h), that of x - origin (2^-53 of the largest coordinate) and float
// underflow.

#if defined(CONTACTCHECK_LAZY_BOUNDS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_BOUNDS_INL
#undef CONTACTCHECK_LAZY_BOUNDS_INL
#else
#define CONTACTCHECK_LAZY_BOUNDS_INL
#endif

#include <hwy/highway.h>

#include <limits>

#include "core/lazy/lazy_state.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatLanes = hn::CappedTag<float, kBlockWidth>;
using FloatVec = hn::Vec<FloatLanes>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Running bounds of some lanes.
struct Range {
  FloatVec lo, hi;
};

HWY_INLINE void include(Range& range, FloatVec x) {
  range.lo = hn::Min(range.lo, x);
  range.hi = hn::Max(range.hi, x);
}

// Local coordinates of the children in one home cell: exact, quantised values are floats.
HWY_INLINE FloatVec local_of(const std::array<std::uint16_t, kBlockWidth>& steps,
                             std::size_t first) {
  const FloatLanes d;
  const hn::Rebind<std::uint16_t, FloatLanes> d16;
  const hn::Rebind<std::int32_t, FloatLanes> d32;
  const auto wide = hn::PromoteTo(d32, hn::LoadU(d16, steps.data() + first));
  return hn::Mul(hn::ConvertTo(d, wide), hn::Set(d, static_cast<float>(1 / HomePieces::kSteps)));
}

struct BoxLanes {
  FloatVec lo[3], hi[3];
};

// One coordinate of the images of the eight corners of each lane's box. `corner`: that coordinate
// of the cell's nodes.
HWY_INLINE Range image_range(const float (&corner)[8], const BoxLanes& box) {
  const FloatLanes d;
  Range range{hn::Set(d, kInfinity), hn::Set(d, -kInfinity)};
  FloatVec along_s[2][4];  // at the low and high end of s, per edge
  for (int edge = 0; edge < 4; ++edge) {
    const auto from = hn::Set(d, corner[2 * edge]);
    const auto way = hn::Set(d, corner[2 * edge + 1] - corner[2 * edge]);
    along_s[0][edge] = hn::MulAdd(box.lo[0], way, from);
    along_s[1][edge] = hn::MulAdd(box.hi[0], way, from);
  }
  for (const auto& edge : along_s) {
    const auto near_way = hn::Sub(edge[1], edge[0]), far_way = hn::Sub(edge[3], edge[2]);
    for (const auto& t : {box.lo[1], box.hi[1]}) {
      const auto near = hn::MulAdd(t, near_way, edge[0]);
      const auto way = hn::Sub(hn::MulAdd(t, far_way, edge[2]), near);
      include(range, hn::MulAdd(box.lo[2], way, near));
      include(range, hn::MulAdd(box.hi[2], way, near));
    }
  }
  return range;
}

struct CellCorners {
  float axis[3][8];
};

HWY_INLINE CellCorners corners_in_frame(const LazyState& state, std::uint32_t cell) {
  CellCorners out;
  const CornerIds& ids = state.shape->lattice->cell_nodes[cell];
  for (int c = 0; c < 8; ++c)
    for (int k = 0; k < 3; ++k) out.axis[k][c] = state.near_nodes[ids[c]].v[k];
  return out;
}

HWY_INLINE void bound_pieces(const LazyState& state, const TreeBlock& block, LaneBoxes& out) {
  const FloatLanes d;
  const auto slack = hn::Set(d, state.slack);
  const auto none = hn::Set(d, kInfinity);
  for (std::size_t first = 0; first < kBlockWidth; first += hn::Lanes(d)) {
    Range total[3];
    for (Range& range : total) range = {none, hn::Neg(none)};
    for (std::uint32_t p = block.begin; p < block.end; ++p) {
      const HomePieces& home = state.tree->pieces[p];
      const auto bits = static_cast<std::uint8_t>(home.children >> first);
      if (bits == 0) continue;
      const auto present = hn::LoadMaskBits(d, &bits);
      const CellCorners corners = corners_in_frame(state, home.cell);
      BoxLanes box;
      for (int k = 0; k < 3; ++k) {
        box.lo[k] = local_of(home.lo[k], first);
        box.hi[k] = local_of(home.hi[k], first);
      }
      for (int k = 0; k < 3; ++k) {
        const Range range = image_range(corners.axis[k], box);
        total[k].lo = hn::Min(total[k].lo, hn::IfThenElse(present, range.lo, none));
        total[k].hi = hn::Max(total[k].hi, hn::IfThenElse(present, range.hi, hn::Neg(none)));
      }
    }
    for (int k = 0; k < 3; ++k) {
      hn::Store(hn::Sub(total[k].lo, slack), d, out.lo[k] + first);
      hn::Store(hn::Add(total[k].hi, slack), d, out.hi[k] + first);
    }
  }
}

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

HWY_INLINE PointRange no_points() { return {all_equal(kInfinity), all_equal(-kInfinity)}; }

HWY_INLINE void include(PointRange& range, const Point& p) {
  range.lo = least_of(range.lo, p);
  range.hi = most_of(range.hi, p);
}

// The cell's edges along one axis.
HWY_INLINE PointRange edges(const LazyState& state, std::uint32_t cell, int axis) {
  const CornerIds& ids = state.shape->lattice->cell_nodes[cell];
  const int step = 1 << axis;
  PointRange range = no_points();
  for (int c = 0; c < 8; ++c)
    if ((c & step) == 0)
      include(range, difference_of(node(state, ids[c | step]), node(state, ids[c])));
  return range;
}

// Where vertices with another home may lie, given the hull of the owners' nodes.
HWY_INLINE PointRange beyond(const LazyState& state, const Stray& stray, PointRange hull) {
  for (int k = 0; k < 3; ++k) {
    if (stray.side[k] == 0) continue;
    const PointRange edge = edges(state, stray.cell, k);
    const Point way = all_equal(stray.side[k] > 0 ? stray.reach[k] : -stray.reach[k]);
    const Point one = product_of(way, edge.lo), other = product_of(way, edge.hi);
    hull.lo = sum_of(hull.lo, least_of(least_of(one, other), all_equal(0.0f)));
    hull.hi = sum_of(hull.hi, most_of(most_of(one, other), all_equal(0.0f)));
  }
  return hull;
}

HWY_INLINE PointRange bound_hull(const LazyState& state, const HullChild& hull) {
  const LatticeTree& tree = *state.tree;
  PointRange own = no_points();
  for (std::uint32_t n = hull.node_begin; n < hull.node_end; ++n)
    include(own, node(state, tree.hull_nodes[n]));
  PointRange all = own;
  for (std::uint32_t s = hull.stray_begin; s < hull.stray_end; ++s) {
    const PointRange strayed = beyond(state, tree.strays[s], own);
    include(all, strayed.lo);
    include(all, strayed.hi);
  }
  const Point slack = all_equal(state.slack);
  all.lo = difference_of(all.lo, slack);
  all.hi = sum_of(all.hi, slack);
  return all;
}

HWY_INLINE void bound_hulls(const LazyState& state, const TreeBlock& block, LaneBoxes& out) {
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

// The bounds of a block's children in this frame.
HWY_INLINE const LaneBoxes& bounds(LazyState& state, std::uint32_t index, LazyCounters& counters) {
  LaneBoxes& out = state.block_boxes[index];
  if (state.block_frame[index] == state.frame) return out;
  const TreeBlock& block = state.tree->blocks[index];
  if (block.hull) {
    bound_hulls(state, block, out);
  } else {
    bound_pieces(state, block, out);
  }
  state.block_frame[index] = state.frame;
  ++counters.blocks_bounded;
  return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
