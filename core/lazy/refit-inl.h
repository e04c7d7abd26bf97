// Boxes from all vertices, bottom up: for bodies without a lattice, and where refitting all boxes
// is cheaper than bounding some of them. Compiled once per instruction set (kernels.cpp).

#if defined(CONTACTCHECK_LAZY_REFIT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONTACTCHECK_LAZY_REFIT_INL
#undef CONTACTCHECK_LAZY_REFIT_INL
#else
#define CONTACTCHECK_LAZY_REFIT_INL
#endif

#include <hwy/highway.h>

#include "core/lazy/bounds-inl.h"
#include "core/lazy/leaves-inl.h"

HWY_BEFORE_NAMESPACE();
namespace contactcheck {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

struct FrameBox {
  float lo[3], hi[3];
};

// An end of a box in the body's frame, moved outward:
//   * x -> (x - origin) * scale, rounded to a float, is monotone in x: each of its roundings is.
//   * So the image of the least x is the least image. It is enough to map the ends of boxes.
//   * The slack covers the roundings (bounds-inl.h).
// Floats are in that frame already and need no slack.
HWY_INLINE float end_in_frame(const LazyState& state, int axis, double x, float outward) {
  return static_cast<float>((x - state.origin[axis]) * state.scale) + outward;
}
HWY_INLINE float end_in_frame(const LazyState&, int, float x, float) { return x; }

// The box of a leaf's vertices in the body's frame.
template <class Real>
HWY_INLINE FrameBox box_of_leaf(const LazyState& state, const TreeLeaf& leaf) {
  const std::uint32_t* ids = &state.tree->leaf_vertices[leaf.first_vertex];
  const auto vertices = vertices_in<Real>(state);
  Real lo[3], hi[3];
  for (int k = 0; k < 3; ++k) lo[k] = hi[k] = vertices[ids[0]][k];
  for (std::uint32_t i = 1; i < leaf.vertices; ++i) {
    const Real* v = vertices[ids[i]].data();
    for (int k = 0; k < 3; ++k) {
      lo[k] = v[k] < lo[k] ? v[k] : lo[k];
      hi[k] = v[k] > hi[k] ? v[k] : hi[k];
    }
  }
  FrameBox box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = end_in_frame(state, k, lo[k], -state.slack);
    box.hi[k] = end_in_frame(state, k, hi[k], state.slack);
  }
  return box;
}

HWY_INLINE void join(const FrameBox& from, FrameBox& to) {
  for (int k = 0; k < 3; ++k) {
    to.lo[k] = from.lo[k] < to.lo[k] ? from.lo[k] : to.lo[k];
    to.hi[k] = from.hi[k] > to.hi[k] ? from.hi[k] : to.hi[k];
  }
}

HWY_INLINE FrameBox box_of_block(const LaneBoxes& lanes) {
  FrameBox box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = extreme<true>(lanes.lo[k]);
    box.hi[k] = extreme<false>(lanes.hi[k]);
  }
  return box;
}

template <class Real>
HWY_INLINE void refit(LazyState& state, FrameArena& arena) {
  const LatticeTree& tree = *state.tree;
  for (std::size_t index = tree.blocks.size(); index-- > 0;) {
    const TreeBlock& block = tree.blocks[index];
    auto& bounds = *static_cast<BlockBounds*>(arena.take(sizeof(BlockBounds)));
    LaneBoxes& out = bounds.box;
    for (std::uint32_t c = 0; c < kBlockWidth; ++c) {
      FrameBox box;
      if (c >= block.children) {
        for (int k = 0; k < 3; ++k) box.lo[k] = kInfinity, box.hi[k] = -kInfinity;
      } else if (block.child[c].leaf()) {
        box = box_of_leaf<Real>(state, tree.leaves[block.child[c].index()]);
        if (state.end != nullptr)
          join(box_of_leaf<Real>(*state.end, tree.leaves[block.child[c].index()]), box);
      } else {
        box = box_of_block(state.blocks.find(block.child[c].index())->box);
      }
      for (int k = 0; k < 3; ++k) {
        out.lo[k][c] = box.lo[k];
        out.hi[k][c] = box.hi[k];
      }
    }
    state.blocks.put(static_cast<std::uint32_t>(index), &bounds);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace contactcheck
HWY_AFTER_NAMESPACE();

#endif
