// The answer of a detector to one frame: sets of pairs.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

namespace contactcheck {

/// Two bodies; canonical when a < b.
struct BodyPair {
  std::uint32_t a = 0, b = 0;
  auto operator<=>(const BodyPair&) const = default;
};

/// An element (cell or triangle, by the set it stands in) of body_a with one of body_b; canonical
/// when body_a < body_b. Element indices are those of the input mesh and of the kept cells.
struct ElementPair {
  std::uint32_t body_a = 0, body_b = 0, a = 0, b = 0;
  auto operator<=>(const ElementPair&) const = default;
};

/// Makes pairs a set: orients each (lower body first), sorts, removes repeats.
void canonicalize(std::vector<ElementPair>& pairs);

/// A vertex of `body` with the solid body `in` that holds it strictly inside.
struct VertexInBody {
  std::uint32_t body = 0, in = 0, vertex = 0;
  auto operator<=>(const VertexInBody&) const = default;
};

/// What was reported for one frame. A detector appends in any order and orientation and may repeat
/// itself; canonicalize() makes it a set.
struct ContactSet {
  std::vector<BodyPair> bodies;
  std::vector<ElementPair> cells;
  std::vector<ElementPair> triangles;
  std::vector<VertexInBody> vertices;

  /// Keeps the capacity, so a reused set does not allocate.
  void clear();
  /// Orients every pair (lower body first), sorts, removes repeats. Element and cell pairs imply
  /// their body pair: it is added.
  void canonicalize();
};

/// Order-free hash of a canonical set, chained over frames: feed the previous frame's value.
std::uint64_t chain_hash(std::uint64_t previous, std::uint64_t frame, const ContactSet& contacts);

}  // namespace contactcheck
