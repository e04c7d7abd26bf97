// The scene `random-pairs`: as many random hard pairs of triangles as one asks for, from a seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/deform/node_shape.h"
#include "reference/scene/pair_kinds.h"

namespace contactcheck {

struct PairSpec {
  std::uint64_t count = 0, seed = 1;
};
/// The id of the scene that they make.
inline constexpr const char* kPairsSceneId = "random-pairs";
constexpr std::uint64_t kMostPairs = 100'000'000;
constexpr std::uint64_t kLargestPairSeed = (std::uint64_t{1} << 53) - 1;  ///< whole in every JSON

/// Two bodies of kSlots separate triangles each; frame f gives pairs f * kSlots and on. Triangle i
/// of the one and triangle i of the other are a pair and have a slot of their own, a box that is
/// disjoint from all other slots: no other pairs can touch. Slots that are left over in the last
/// frame hold two points that are apart.
///
/// Every frame has a scale (2^-30 to 2^30 m), a distance between slots (2^4 to 2^24 times the
/// triangles' size) and a place (up to 2^16 times that distance from the origin) of its own. Every
/// kind of pair is in every frame and, in turn, in every slot.
///
/// Nothing is kept: a frame is made when it is asked for, the same each time.
class RandomPairs {
 public:
  static constexpr std::size_t kSlots = 576;

  /// @pre 1 <= count <= kMostPairs
  explicit RandomPairs(PairSpec spec);

  const PairSpec& spec() const { return spec_; }
  std::size_t frames() const;
  /// Pairs of a frame: slots 0 to this - 1.
  std::size_t pairs_of_frame(std::size_t frame) const;
  static PairKind kind_of(std::size_t frame, std::size_t slot);
  HardPair pair(std::size_t frame, std::size_t slot) const;
  /// Both corners exact doubles; the pair lies strictly inside.
  Aabb slot_box(std::size_t frame, std::size_t slot) const;

  /// Of both bodies. Vertices are lattice nodes: any bits come through the mapping.
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

}  // namespace contactcheck
