// The lazy detector's inner loops, compiled for every instruction set of the platform and chosen at
// run time.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/lazy/lazy_state.h"
#include "core/lazy/triangle_batch.h"
#include "core/types/contact_set.h"

namespace contactcheck {

/// A child slot of each of two trees.
struct SlotPair {
  std::uint32_t block_a, lane_a, block_b, lane_b;
};

struct LeafPair {
  std::uint32_t a, b;
};

/// The front of the bounding-volume test tree (BVTT) of two bodies: slots whose bounds meet and are
/// still to be opened, and leaves whose triangles are still to be tested.
struct BvttFront {
  std::vector<SlotPair> slots;
  std::vector<LeafPair> leaves;
};

/// A part of a front.
struct FrontPart {
  std::span<const SlotPair> slots;
  std::span<const LeafPair> leaves;
};

/// Working memory of one thread. Lives as long as the states that point into its arena.
struct LazyScratch {
  FrameArena arena;
  BvttFront open;
  std::vector<SlotPair> level;
  std::vector<std::uint32_t> own_blocks;  ///< blocks still to be tested against themselves
  TriangleBatchSet<double> batches;
  TriangleBatchSet<float> single_batches;          ///< used instead in single precision
  LazyCounters counters;                           ///< without those that count_made() adds
  std::vector<ElementPair>* candidates = nullptr;  ///< if set, records tested pairs
};

/// Two placed bodies of one frame and one precision, after find_cells() or bound_all().
struct BodiesToTest {
  BodyPair names;
  LazyState& a;
  LazyState& b;
};

struct LazyKernels {
  const char* name;  ///< as Highway names the target: "AVX3", "AVX2", "SSE4", ...
  /// Appends the intersecting pairs of triangles, each once; stops at the first if `first_only`.
  void (*collide)(BodiesToTest bodies, bool first_only, LazyScratch& scratch,
                  std::vector<ElementPair>& out);
  /// The same for one body and itself (`bodies` names it twice): pairs of its triangles that meet
  /// in more than the vertices they share.
  void (*collide_self)(BodiesToTest bodies, bool first_only, LazyScratch& scratch,
                       std::vector<ElementPair>& out);
  /// Opens pairs that meet, level by level, until the front has `slots` slots or none is left.
  void (*spread)(BodiesToTest bodies, std::size_t slots, LazyScratch& scratch, BvttFront& front);
  /// collide() of a part of the front of spread(). All parts together find what collide() finds.
  void (*collide_part)(BodiesToTest bodies, FrontPart part, bool first_only, LazyScratch& scratch,
                       std::vector<ElementPair>& out);
  /// Bounds every block of the body, in order of their indices. For refitted bodies and validate().
  void (*bound_all)(LazyState& state, FrameArena& arena);
  /// The filtered test of up to eight pairs, of doubles or of floats.
  BatchVerdict (*test_batch)(const TriangleBatch& batch);
  BatchVerdict (*test_single_batch)(const SingleTriangleBatch& batch);
  /// Maps one leaf, once per frame.
  const LeafCache& (*map_leaf)(LazyState& state, std::uint32_t leaf, FrameArena& arena);
  const SingleLeafCache& (*map_single_leaf)(LazyState& state, std::uint32_t leaf,
                                            FrameArena& arena);
};

/// The kernels for this processor, or for a named instruction set.
/// @throws Unavailable, naming the available ones, when it is not compiled in or does not run here
const LazyKernels& lazy_kernels(const std::string& isa = "best");

/// Names of the instruction sets that run here, best first.
std::vector<std::string> lazy_isas();
/// Names of those that are compiled in, best first.
std::vector<std::string> compiled_lazy_isas();

}  // namespace contactcheck
