// The scene `random-pairs`: a requested number of random hard pairs of triangles, from a seed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/deform/node_shape.h"
#include "core/types/vec3.h"
#include "reference/scene/scene.h"
#include "reference/scene/split_mix.h"

namespace contactcheck::scene {

/// The random numbers of one pair.
class PairRandom {
 public:
  /// Each stream of a seed is a separate sequence, so any pair can be made without those before it.
  PairRandom(std::uint64_t seed, std::uint64_t stream)
      : mix_(SplitMix64::mixed(SplitMix64::mixed(seed) + stream)) {}

  std::uint64_t bits() { return mix_.bits(); }
  /// Uniform in 0 .. count - 1 (up to a bias of count / 2^64).
  int below(int count) { return static_cast<int>(bits() % static_cast<std::uint64_t>(count)); }
  /// Uniform in least .. most.
  int between(int least, int most) { return least + below(most - least + 1); }
  bool coin() { return below(2) == 0; }
  /// Uniform in [low, high), in steps of (high - low) / 2^53.
  double between(double low, double high) {
    return low + static_cast<double>(bits() >> 11) * 0x1p-53 * (high - low);
  }

 private:
  SplitMix64 mix_;
};

// Pairs of triangles that touch or just do not; each kind is hard for another reason.

/// Where two triangles nearly touch, or their shape.
enum class PairKind {
  kVertexFace,    ///< a corner on a face
  kVertexEdge,    ///< a corner on an edge
  kEdgeEdge,      ///< two edges that cross
  kVertexVertex,  ///< a common corner
  kSharedEdge,    ///< two common corners
  kNearCoplanar,  ///< the corners of one in the plane of the other, as near as rounding lets them
  kCoplanar,      ///< exactly in one plane, with corners on one coarse grid
  kSliver,        ///< one triangle is a few units in the last place wide
  kSegment,       ///< one triangle, or both, are exactly a segment
  kPoint,         ///< one triangle is exactly a point
  kMixedScale     ///< one triangle is 2^10 to 2^40 times the other
};
constexpr std::size_t kPairKinds = 11;
const char* name_of(PairKind kind);

/// A pair is made around `center`; its larger triangle has a size of about `size` metres.
struct PairPlace {
  Vec3 center = Vec3::Zero();
  double size = 1.0;
};

struct HardPair {
  std::array<Vec3, 3> a, b;
};

/// No corner is farther from the center than this many sizes, along any axis.
constexpr double kPairReach = 7.0;

/// Points of contact are computed in double, so they are off by rounding only; in about half of the
/// pairs they are then moved by up to two units in the last place. Only additions, products,
/// quotients and square roots are used: the same bits on every machine.
HardPair make_hard_pair(PairKind kind, const PairPlace& place, PairRandom& random);

/// The id of the scene.
inline constexpr const char* kPairsSceneId = "random-pairs";
constexpr std::uint64_t kMostPairs = 100'000'000;
constexpr std::uint64_t kLargestPairSeed = (std::uint64_t{1} << 53) - 1;  ///< whole in every JSON

/// Two bodies of kSlots separate triangles each; frame f contains the pairs from f * kSlots on.
/// Triangle i of one body and triangle i of the other are a pair in one slot, a box that is
/// disjoint from all other slots, so no other pairs can touch. Unused slots of the last frame
/// contain two disjoint points.
///
/// Each frame has its scale (2^-30 to 2^30 m), its distance between slots (2^4 to 2^24 times the
/// triangles' size) and its position (up to 2^16 times that distance from the origin). Every kind
/// of pair occurs in every frame and, in turn, in every slot.
///
/// Nothing is stored: a frame is computed on demand, with the same result each time.
class RandomPairs {
 public:
  static constexpr std::size_t kSlots = 576;

  /// @pre 1 <= count <= kMostPairs
  explicit RandomPairs(PairSpec spec);

  const PairSpec& spec() const { return spec_; }
  std::size_t frames() const;
  /// The number of pairs in a frame; they use slots 0 to this - 1.
  std::size_t pairs_of_frame(std::size_t frame) const;
  static PairKind kind_of(std::size_t frame, std::size_t slot);
  HardPair pair(std::size_t frame, std::size_t slot) const;
  /// A box whose corners are exact doubles; the pair lies strictly inside.
  Aabb slot_box(std::size_t frame, std::size_t slot) const;

  /// The shape of both bodies. Vertices are lattice nodes, so mapping keeps any bits.
  const std::shared_ptr<const BodyShape>& shape() const { return on_nodes_.shape; }
  /// [body][node]
  std::vector<std::vector<Vec3>> nodes(std::size_t frame) const;

 private:
  struct Regime;
  Regime regime_of(std::size_t frame) const;
  HardPair pair_in(const Regime& regime, std::size_t frame, std::size_t slot) const;

  PairSpec spec_;
  NodeShape on_nodes_;
};

}  // namespace contactcheck::scene
