// How a case of a family moves a body's positions: lattice nodes, or vertices without a lattice.
// Sums, products and quotients of doubles alone: the same bits on every machine.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/deform/lattice.h"
#include "reference/scene/amount.h"

namespace contactcheck {

struct FamilyStep {
  enum class Kind {
    kScale,      ///< by `vector`, per axis, about the origin
    kTranslate,  ///< by `vector`
    kRotate,     ///< by `quaternion` over its squared length: a rotation without angles
    kRound,      ///< to the nearest multiple of `amount`
    kMoveNode,   ///< the lattice's node `node` by `vector`
    kMoveVertex  ///< the mesh's vertex `vertex` by `vector`; no lattice, or one of nodes
  };
  Kind kind = Kind::kScale;
  AmountVector vector = {};
  std::array<Amount, 4> quaternion = {};  ///< w, x, y, z
  Amount amount;
  GridIndex node = {};
  std::size_t vertex = 0;
};

/// @throws InputError
FamilyStep parse_family_step(const JsonField& field);

/// `lattice`: whose nodes the positions are; null for vertices. @pre the node or vertex exists
void apply(const FamilyStep& step, double parameter, const Lattice* lattice,
           std::span<Vec3> positions);

}  // namespace contactcheck
