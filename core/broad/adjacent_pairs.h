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

/// More than this are refused: a vertex of n triangles has n (n - 1) / 2 pairs.
inline constexpr std::size_t kMostAdjacentPairs = 40'000'000;

/// Each pair once, a < b, ascending; without duplicates (triangles that name the same vertices).
/// @throws RefusedInput for more than kMostAdjacentPairs
std::vector<AdjacentPair> adjacent_pairs(std::span<const Triangle> triangles);

}  // namespace contactcheck
