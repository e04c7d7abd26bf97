// The lazy detector's state of one body in one frame. Bounds and mapped leaves are computed on
// first use, by any thread, and stamped with the frame.
//
// Bounds are floats in the body's frame: (x - origin) * scale, with a power of two common to all
// bodies as scale. The origin is the middle of the scene where bodies are not small against it,
// else the middle of each body. So neither a scene far out nor a body far from the others loses
// precision, and neither overflow nor underflow spoils a bound.
//
// In single precision that frame is all there is: float(x - origin) * scale, with the local origin
// of the scene (core/types/local_origin.h) and the power of two that brings its half-width below 1.
// Nodes are rounded once, by the difference; the scale changes no digit, except of values below
// 2^-126 of the scene. Vertices are mapped from these floats, and boxes and triangle tests use only
// them, never the doubles.
//
// Over a step (core/types/frame.h) bounds and boxes of leaves hold the vertices at both ends, and
// so, since they are convex, all that moves straight between. Each body has a frame of its own that
// moves with it: the state at the end has another origin, and a body that moves without turning is
// at rest there. Two bodies that meet at some t are compared in one of the two frames, in which the
// other one's bounds are drawn out from the difference of the origins at the start to that at the
// end (meeting-inl.h). What is tested in the end are the doubles at both ends.
//
// What is found in single precision: exactly the pairs of triangles of these floats that intersect.
// The same on every instruction set and number of threads, and whether bounds come from nodes or
// from vertices.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/lazy/lattice_tree.h"
#include "core/types/semantics.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// Memory that lives until the next frame; nothing is freed and pointers stay valid.
class FrameArena {
 public:
  void clear() { chunk_ = used_ = 0; }
  /// Aligned to 64 bytes. @pre bytes <= kChunk
  void* take(std::size_t bytes) {
    bytes = (bytes + 63) / 64 * 64;
    if (chunk_ == chunks_.size() || used_ + bytes > kChunk) next_chunk();
    void* out = chunks_[chunk_]->bytes + used_;
    used_ += bytes;
    return out;
  }
  std::size_t bytes() const { return chunks_.size() * kChunk; }

 private:
  static constexpr std::size_t kChunk = std::size_t{1} << 16;
  struct alignas(64) Chunk {
    std::byte bytes[kChunk];
  };
  void next_chunk() {
    if (chunk_ < chunks_.size() && used_ > 0) ++chunk_;
    if (chunk_ == chunks_.size()) chunks_.push_back(std::unique_ptr<Chunk>(new Chunk));
    used_ = 0;
  }
  std::vector<std::unique_ptr<Chunk>> chunks_;
  std::size_t chunk_ = 0, used_ = 0;
};

/// Cache of entries computed in this frame, by index. Threads that miss an entry at the same time
/// each compute it in their own arena and store it. All compute the same bits, so it does not
/// matter whose entry stays or is read. `Stamp`: the unsigned type of the frame counter; before it
/// overflows, the table is cleared.
template <class T, class Stamp = std::uint32_t>
class FrameTable {
 public:
  /// Begins a frame: invalidates all entries. Not while others use the table.
  void begin_frame(std::size_t size) {
    if (entries_.size() != size || frame_ == std::numeric_limits<Stamp>::max()) {
      entries_ = std::vector<Entry>(size);
      frame_ = 0;
    }
    ++frame_;
  }
  /// The entry of this frame, or null.
  T* find(std::uint32_t index) const {
    const Entry& entry = entries_[index];
    if (entry.frame.load(std::memory_order_acquire) != frame_) return nullptr;
    return entry.made.load(std::memory_order_acquire);
  }
  void put(std::uint32_t index, T* made) {
    Entry& entry = entries_[index];
    entry.made.store(made, std::memory_order_release);
    entry.frame.store(frame_, std::memory_order_release);
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(entries_.size()); }
  std::size_t bytes() const { return entries_.size() * sizeof(Entry); }

 private:
  struct Entry {
    std::atomic<T*> made = nullptr;
    std::atomic<Stamp> frame = 0;
  };
  std::vector<Entry> entries_;
  Stamp frame_ = 0;
};

using Float4 = Eigen::Array4f;  ///< x, y, z, 0

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

/// Bounds of the eight children of a block, in the body's frame.
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
  const LaneBoxes* boxes = nullptr;  ///< one lane per triangle
  const LaneBoxes* whole = nullptr;  ///< lane 0: box of all triangles
};
using LeafCache = LeafCacheOf<double>;
using SingleLeafCache = LeafCacheOf<float>;

/// Replaces the nodes, vertices and leaves of a body in single precision. All coordinates are in
/// the body's frame.
struct SingleBody {
  std::vector<Vec3f> nodes;
  std::span<const Vec3f> vertices;  ///< if from_vertices
  FrameTable<SingleLeafCache> leaves;
};

/// Work done since the last update. If all pairs were queried, all counters but the first depend on
/// the frame alone. Which blocks are bounded depends on the order of the pairs, so on the threads.
struct LazyCounters {
  std::uint64_t blocks_bounded = 0;  ///< eight children each
  std::uint64_t leaves_mapped = 0;
  std::uint64_t vertices_mapped = 0;  ///< a vertex of several leaves counts in each
  std::uint64_t block_pairs = 0;      ///< visited
  std::uint64_t leaf_pairs = 0;       ///< whose boxes overlap
  std::uint64_t triangle_tests = 0;   ///< pairs whose boxes overlap
  std::uint64_t filter_failures = 0;  ///< of these, left to the exact test
};

struct PatchTree;  // embedded_patch.h

struct LazyState {
  const BodyShape* shape = nullptr;
  const LatticeTree* tree = nullptr;
  Precision precision = Precision::kDouble;
  const PatchTree* patches = nullptr;  ///< for self-contact; else null
  /// Results of stays_embedded() cached in this frame; no embedded_children: none yet.
  std::vector<std::uint8_t> embedded_ones, embedded_eights, embedded_children;
  bool from_vertices = false;      ///< all bounds are refitted to `vertices`; else lazily to nodes
  std::span<const Vec3> nodes;     ///< the frame's
  std::span<const Vec3> vertices;  ///< the same, if from_vertices
  Aabb box;                        ///< contains all nodes or vertices; single: in the body's frame
  double largest = 0.0;            ///< |coordinate| of them

  Vec3 origin = Vec3::Zero();
  double scale = 1.0;
  double reach = 0.0;       ///< largest |coordinate| of the body in its frame
  float slack = 0.0f;       ///< by which bounds are moved outward; derivation in bounds-inl.h
  float slab_slack = 0.0f;  ///< the same for slabs
  std::vector<Float4> near_nodes;  ///< nodes in the body's frame, divided by 8
  std::vector<CellTerms> cells;    ///< per kept cell, in the body's frame
  bool cells_known = false;

  /// The state at the end of a step, of which this is the start: bounds and boxes are then of both.
  /// Null in a frame. Not in single precision.
  const LazyState* end = nullptr;

  FrameTable<BlockBounds> blocks;
  FrameTable<LeafCache> leaves;
  SingleBody single;
};

/// Inputs and caches of mapped leaves, selected by precision.
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

/// The power of two that brings x into [1/2, 1), limited to 2^-1000 .. 2^1000: an x above 2^1000
/// comes below 2^24, one below 2^-1000 to 2^-74 at least. 1 for 0.
double scale_to_one(double x);

/// Invalidates per-frame state.
void forget_frame(LazyState& state);

/// Starts a frame in doubles (single precision: begin_frame_in_single). The body's box is that of
/// its lattice's nodes, enlarged by rounding. If `from_vertices`, the caller sets `vertices` before
/// blocks are bounded. @pre shape, tree and from_vertices are set
void begin_frame_by_nodes(LazyState& state, std::span<const Vec3> nodes);

/// The same for a body with given vertices. @pre also from_vertices
void begin_frame_by_vertices(LazyState& state, std::span<const Vec3> vertices);

/// Begins the frame that `before` has begun, whose nodes and vertices are bit for bit these: the
/// box is taken from there. @pre `before` is of the same shape and tree, and not the start of a
/// step
void begin_same_frame(LazyState& state, const LazyState& before, std::span<const Vec3> nodes,
                      std::span<const Vec3> vertices);

/// Makes the box that of the vertices instead of the nodes. Once the bodies are placed.
/// @pre from_vertices, and `vertices` are set
void tighten_box(LazyState& state);

/// Chooses origins, scale and slacks of all bodies. @pre begin_frame_by_... was called for each
void place(std::span<LazyState> states);

/// The same of a step: the states at both ends have begun their frames. The frame of a body moves
/// with the middle of its box (not near the largest double), and `end` is placed by its start.
/// @pre each state has an `end`
void place_step(std::span<LazyState> states, std::span<LazyState> ends);

/// False if the boxes of two bodies, which move straight, are on the same two sides along an axis
/// at both ends of a step: the bodies do not meet. Exact. @pre each state has an `end`
bool may_meet(const LazyState& a, const LazyState& b);

/// Starts a frame in single precision: rounds `nodes` (without a lattice: vertices) about `origin`.
/// @pre shape, tree and from_vertices are set; in single precision
/// @throws RefusedInput when one is farther from the origin than kSingleLimit
void begin_frame_in_single(LazyState& state, std::span<const Vec3> nodes, const Vec3& origin);

/// Scales the rounded nodes to the frame common to all bodies, and computes boxes and slacks. If
/// from_vertices, the caller sets `single.vertices` before blocks are bounded.
/// @pre begin_frame_in_single was called for each with this origin
void place_in_single(std::span<LazyState> states, const Vec3& origin);

/// The body's vertices in its frame, mapped one by one by map_point() (core/deform). For tests:
/// leaves and refitted bodies must have the same. @pre place_in_single was called
std::vector<Vec3f> single_vertices(const LazyState& state);

/// Adds the numbers of blocks bounded, leaves and vertices mapped in this frame.
void count_made(const LazyState& state, LazyCounters& counters);

/// Computes near_nodes and cells once per frame, unless from_vertices. @pre the bodies are placed
void find_cells(LazyState& state);

/// Checks that every block's lane contains the mapped `vertices` of every triangle below it.
/// Returns a sentence for the first violation, or "".
/// @pre all blocks are bounded in this frame (LazyKernels::bound_all)
std::string validate(const LazyState& state, std::span<const Vec3> vertices);

/// The same in single precision. `vertices`: in the body's frame.
std::string validate(const LazyState& state, std::span<const Vec3f> vertices);

}  // namespace contactcheck
