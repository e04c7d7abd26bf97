// The hierarchy of bounding spheres of one shape, at rest: which lattice node is each sphere's
// centre and which cells belong to it. One sphere at the top; each sphere of the next level belongs
// to one of the level above and contains a part of its cells.
// Source: Jeon, Hong, Choi, Jeong 2013: level 1 encloses the object, level 2 "somewhat overlapped",
// each centre a node of the object; deeper levels are named there and not done.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/deform/lattice.h"

namespace contactcheck {

struct SphereNode {
  std::uint32_t parent = 0;       ///< index in the level above; 0 at the top
  std::uint32_t center_node = 0;  ///< lattice node that is the centre; unused at the top
  std::uint32_t child_begin = 0,
                child_end = 0;  ///< its spheres of the next level; none at the last
  std::vector<std::uint32_t> cells;
};

struct SphereTree {
  std::vector<std::vector<SphereNode>> levels;  ///< levels[0] has one sphere
};

/// Clusters the given cells: per level each sphere is split into up to `children` spheres, whose
/// centres are nodes of its cells chosen far apart (each next one farthest from those before, the
/// lowest index where equal), cells going to the nearest centre. Deterministic.
/// @pre levels >= 1, children >= 1; without cells only the top exists
SphereTree make_sphere_tree(const Lattice& lattice, std::span<const std::uint32_t> cells,
                            int levels, int children);

}  // namespace contactcheck
