// What a mesh is: its defects by name and index, and whether it bounds a solid.
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
/// True for defects no detector can be given: empty, non-finite, index out of range.
bool is_fatal(MeshDefectKind kind);

struct MeshTopology {
  std::vector<MeshDefect> defects;  ///< all of them, in the order of the kinds, then index
  bool fatal = false;
  /// Edge-manifold, closed, consistently oriented: inside is defined.
  bool solid = false;

  std::size_t count(MeshDefectKind kind) const;
};

/// Of a mesh that is used. So many triangles have fewer corners than 2^32 and fewer blocks of a
/// tree than 2^29 (core/lazy); indices of vertices fit into 31 bits, as those of Python's arrays
/// do.
inline constexpr std::uint64_t kMostMeshTriangles = std::uint64_t{1} << 29;
inline constexpr std::uint64_t kMostMeshVertices = (std::uint64_t{1} << 31) - 1;

/// "has 600000000 triangles; at most 536870912 can be judged"; empty for a mesh within the limits.
std::string mesh_size_fault(std::uint64_t vertices, std::uint64_t triangles);

/// Lists every defect of `mesh`; never throws for bad meshes. @pre no mesh_size_fault()
MeshTopology analyse_topology(const TriangleMesh& mesh);

/// "3 boundary-edge (first: triangle 17), 1 zero-area-triangle (triangle 4)"; empty without
/// defects.
std::string describe(const MeshTopology& topology);

/// More pairs of triangles that share a vertex are never judged: a vertex of n triangles has
/// n (n - 1) / 2. A pair that shares two vertices counts twice.
inline constexpr std::uint64_t kMostAdjacentPairs = 40'000'000;

/// @throws RefusedInput for more than kMostAdjacentPairs, with their count and the vertex with most
void refuse_many_adjacent_pairs(std::span<const Triangle> triangles);

}  // namespace contactcheck
