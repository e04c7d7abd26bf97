// Every random pair judged a second time, in rational arithmetic: what the oracle itself is worth.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reference/compare/judge.h"
#include "reference/oracle/oracle.h"
#include "reference/scene/random_pairs.h"

namespace contactcheck {

struct PairTally {
  struct Kind {
    std::uint64_t pairs = 0, touching = 0;
  };
  std::array<Kind, kPairKinds> kinds;  ///< touching by rational arithmetic
  /// Pairs on which the oracle differs; also such as cannot touch, of triangles in two slots.
  std::uint64_t oracle_wrong = 0;
  /// The first pair that the oracle missed and the first that it made up, level `triangle`; scene
  /// and detector left empty.
  std::vector<Disagreement> disagreements;

  std::uint64_t checked() const;
  std::uint64_t touching() const;
};

class PairCheck {
 public:
  /// `threads` share the pairs of a frame; 0: as many as the machine has. The tally does not depend
  /// on it. `pairs` must outlive it.
  explicit PairCheck(const RandomPairs& pairs, unsigned threads = 0);

  /// `vertices`: of both bodies; `truth`: what the oracle says of them.
  void add_frame(std::size_t frame, const std::vector<std::vector<Vec3>>& vertices,
                 const Truth& truth);
  const PairTally& tally() const { return tally_; }

 private:
  std::vector<char> touching_pairs(std::size_t count,
                                   const std::vector<std::vector<Vec3>>& vertices) const;
  void book(const char* kind, std::size_t frame, const ElementPair& pair);

  const RandomPairs& pairs_;
  unsigned threads_;
  PairTally tally_;
};

}  // namespace contactcheck
