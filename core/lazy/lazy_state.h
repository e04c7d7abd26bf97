// What the lazy detector knows about one body in one frame. Bounds and mapped leaves are made when
// first asked for, by any thread, and stamped with the frame.
//
// Bounds are floats in the body's frame: (x - origin) * scale, with a power of two common to all
// bodies as scale. The origin is the middle of the scene where bodies are not small beside it, else
// the middle of each body. So a scene far out loses nothing, nor does a body far from the others,
// and neither overflow nor underflow spoils a bound.
//
// In single precision (single_frame.h) that frame is all there is: nodes are rounded into it once,
// vertices are mapped and triangles tested in it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/lazy/frame_memory.h"
#include "core/lazy/lattice_tree.h"
#include "core/types/semantics.h"
#include "core/types/vec3.h"

namespace contactcheck {

using Float4 = Eigen::Array4f;  ///< the last is 0

/// The deformed cell as a function of y = 2 x - 1 in [-1, 1]^3: the sum over i of term[i] times the
/// product of y_k over the bits k of i.
struct CellTerms {
  std::array<Float4, 8> term;
};

/// Bounds of eight children, one lane each. Lanes without a child are empty (lo > hi).
struct alignas(64) LaneBoxes {
  float lo[3][kBlockWidth];
  float hi[3][kBlockWidth];
};

/// Slabs of eight children: n . x lies within `half` of `middle`. Without a slab: normal 0, half
/// kNoSlab.
struct alignas(64) LaneSlabs {
  float normal[3][kBlockWidth];
  float middle[kBlockWidth];
  float half[kBlockWidth];
};
inline constexpr float kNoSlab = 1e30f;

/// Of the eight children of a block.
struct BlockBounds {
  LaneBoxes box;
  LaneSlabs slab;  ///< never written where bounds come from vertices
};

/// The mapped leaf: its vertices as map_point() gives them, and the boxes of its triangles in the
/// body's frame. Doubles are world coordinates; floats are in the body's frame.
template <class Real>
struct LeafCacheOf {
  const Real* x = nullptr;
  const Real* y = nullptr;
  const Real* z = nullptr;
  const LaneBoxes* boxes = nullptr;  ///< of kLeafTriangles triangles
  const LaneBoxes* whole = nullptr;  ///< lane 0: of all of them
};
using LeafCache = LeafCacheOf<double>;
using SingleLeafCache = LeafCacheOf<float>;

/// What a body in single precision has instead of nodes, vertices and leaves in doubles: the same
/// in the body's frame.
struct SingleBody {
  std::vector<Vec3f> nodes;
  std::span<const Vec3f> vertices;  ///< if from_vertices
  FrameTable<SingleLeafCache> leaves;
};

/// What was done, since the last update. Where all pairs were asked for, all but the first depend
/// on the frame alone; which blocks are bounded depends on the order of the pairs, so on the
/// threads.
struct LazyCounters {
  std::uint64_t blocks_bounded = 0;  ///< eight children each
  std::uint64_t leaves_mapped = 0;
  std::uint64_t vertices_mapped = 0;  ///< a vertex of several leaves counts in each
  std::uint64_t block_pairs = 0;      ///< visited
  std::uint64_t leaf_pairs = 0;       ///< whose boxes overlap
  std::uint64_t triangle_tests = 0;   ///< pairs whose boxes overlap
  std::uint64_t filter_failures = 0;  ///< of these, left to the exact test
};

struct LazyState {
  const BodyShape* shape = nullptr;
  const LatticeTree* tree = nullptr;
  Precision precision = Precision::kDouble;
  bool from_vertices = false;      ///< all bounds are refitted to `vertices`; else lazily to nodes
  std::span<const Vec3> nodes;     ///< the frame's
  std::span<const Vec3> vertices;  ///< the same, if from_vertices
  Aabb box;                        ///< holds all nodes or vertices; single: in the body's frame
  double largest = 0.0;            ///< |coordinate|

  Vec3 origin = Vec3::Zero();
  double scale = 1.0;
  double reach = 0.0;       ///< largest |coordinate| of the body in its frame
  float slack = 0.0f;       ///< by which bounds are moved outward; derivation in bounds-inl.h
  float slab_slack = 0.0f;  ///< the same for slabs
  std::vector<Float4> near_nodes;  ///< nodes in the body's frame, over 8
  std::vector<CellTerms> cells;    ///< in the body's frame
  bool cells_known = false;

  FrameTable<BlockBounds> blocks;
  FrameTable<LeafCache> leaves;
  SingleBody single;
};

/// What leaves are mapped from and where they are kept, for loops of either precision.
template <class Real>
std::span<const Vec3Of<Real>> nodes_in(const LazyState& state) {
  if constexpr (std::is_same_v<Real, float>) {
    return state.single.nodes;
  } else {
    return state.nodes;
  }
}
template <class Real>
std::span<const Vec3Of<Real>> vertices_in(const LazyState& state) {
  if constexpr (std::is_same_v<Real, float>) {
    return state.single.vertices;
  } else {
    return state.vertices;
  }
}
template <class Real>
FrameTable<LeafCacheOf<Real>>& leaves_in(LazyState& state) {
  if constexpr (std::is_same_v<Real, float>) {
    return state.single.leaves;
  } else {
    return state.leaves;
  }
}

/// Nothing of the frame is known any more; nothing of the last one is left.
void forget_frame(LazyState& state);

/// Forgets the last frame, in doubles (in single precision: single_frame.h); the body's box is that
/// of its lattice's nodes. Where `from_vertices`, `vertices` is to be set before blocks are
/// bounded. @pre shape, tree and from_vertices are set
void begin_frame_by_nodes(LazyState& state, std::span<const Vec3> nodes);

/// The same for a body whose vertices are known. @pre also from_vertices
void begin_frame_by_vertices(LazyState& state, std::span<const Vec3> vertices);

/// Chooses origins, scale and slacks of all bodies of a frame. @pre begin_frame_by_... of each
void place(std::span<LazyState> states);

/// Adds the blocks, leaves and vertices made in this frame.
void count_made(const LazyState& state, LazyCounters& counters);

/// Takes the lattice into the body's frame, once per frame. @pre place, or place_in_single
void find_cells(LazyState& state);

/// Checks what the bounds promise for the mapped `vertices`: every block's lane holds the vertices
/// of every triangle below it. Returns a sentence for the first broken promise, or "".
/// @pre all blocks are bounded in this frame (LazyKernels::bound_all)
std::string validate(const LazyState& state, std::span<const Vec3> vertices);

/// The same in single precision. `vertices`: in the body's frame.
std::string validate(const LazyState& state, std::span<const Vec3f> vertices);

}  // namespace contactcheck
