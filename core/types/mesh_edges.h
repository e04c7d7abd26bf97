// The edges of a mesh: unordered pairs of two different vertices of a triangle, each once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types/mesh.h"

namespace contactcheck {

/// Two different vertices, the lower first.
using Edge = std::array<std::uint32_t, 2>;

/// An edge's number is its place in `edges`. @pre at most kMostMeshTriangles, so fewer than 2^32
struct MeshEdges {
  /// The number of a side whose two corners are one vertex.
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  std::vector<Edge> edges;                                ///< ascending
  std::vector<std::array<std::uint32_t, 3>> of_triangle;  ///< of side i: corners i and (i + 1) % 3
};

MeshEdges mesh_edges(std::span<const Triangle> triangles);

}  // namespace contactcheck
