// Pairs of triangles of one mesh that share a vertex, from the mesh alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types/mesh.h"
#include "core/types/shared_corners.h"

namespace contactcheck {

struct AdjacentPair {
  std::uint32_t a = 0, b = 0;
  SharedCorners shared;
};

/// Each pair once, a < b, ascending; without duplicates (triangles that name the same vertices).
/// @throws RefusedInput as refuse_many_adjacent_pairs() does
std::vector<AdjacentPair> adjacent_pairs(std::span<const Triangle> triangles);

}  // namespace contactcheck
