// Analyses a mesh: its defects by name and index, and whether it bounds a solid.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/types/mesh.h"

namespace contactcheck {

enum class MeshDefectKind {
  kEmpty,                   ///< no vertex or no triangle
  kNonFiniteVertex,         ///< index: vertex
  kIndexOutOfRange,         ///< index: triangle
  kRepeatedIndex,           ///< index: triangle that names one vertex twice
  kZeroAreaTriangle,        ///< index: triangle with collinear corners (cross product 0 in double)
  kDuplicateTriangle,       ///< index: triangle that names the vertices of one before it
  kNonManifoldEdge,         ///< index: first triangle of an edge with more than two triangles
  kBoundaryEdge,            ///< index: triangle of an edge with one triangle
  kInconsistentOrientation  ///< index: triangle that runs a shared edge the same way as its
                            ///< neighbour
};

struct MeshDefect {
  MeshDefectKind kind;
  std::uint32_t index;
};

const char* name_of(MeshDefectKind kind);
/// True for defects that make a mesh unusable: empty, non-finite vertex, index out of range.
bool is_fatal(MeshDefectKind kind);

struct MeshTopology {
  std::vector<MeshDefect> defects;  ///< by kind, then index; fatal ones hide the others
  bool fatal = false;
  /// Edge-manifold, closed, consistently oriented: inside is defined.
  bool solid = false;

  std::size_t count(MeshDefectKind kind) const;
};

/// Size limits of a mesh. They keep the corners of triangles below 2^32 and the blocks of a tree
/// below 2^29 (core/lazy), and vertex indices within 31 bits, as Python's arrays need.
inline constexpr std::uint64_t kMostMeshTriangles = std::uint64_t{1} << 29;
inline constexpr std::uint64_t kMostMeshVertices = (std::uint64_t{1} << 31) - 1;

/// "has 600000000 triangles; at most 536870912 can be judged"; empty for a mesh within the limits.
std::string mesh_size_fault(std::uint64_t vertices, std::uint64_t triangles);

/// Lists the defects of `mesh`, or only the fatal ones if it has such. Never throws for bad meshes.
/// @pre no mesh_size_fault()
MeshTopology analyse_topology(const TriangleMesh& mesh);

/// "3 boundary-edge (first: triangle 17), 1 zero-area-triangle (triangle 4)"; empty without
/// defects.
std::string describe(const MeshTopology& topology);

/// Limit for self-contact on pairs of triangles that share a vertex. A vertex of n triangles has
/// n (n - 1) / 2; a pair that shares two vertices counts twice.
inline constexpr std::uint64_t kMostAdjacentPairs = 40'000'000;

/// @throws RefusedInput for more than kMostAdjacentPairs, with their count and the vertex with most
void refuse_many_adjacent_pairs(std::span<const Triangle> triangles);

}  // namespace contactcheck
