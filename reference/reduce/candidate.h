// What is reduced: two meshes or more, or one with self-contact, and how they become a scene of one
// frame.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/deform/body.h"
#include "core/types/mesh.h"

namespace contactcheck::reduce {

/// One frame of some bodies as input of a detector.
struct Snapshot {
  std::vector<Body> bodies;
  std::vector<std::vector<Vec3>> nodes;  ///< per body
};

/// Meshes with the vertices at their judged positions.
struct CaseCandidate {
  std::vector<std::string> names;  ///< of the bodies
  std::vector<TriangleMesh> meshes;
  /// The vertices are nodes of a lattice (make_node_shape); else there is no lattice, and the rest
  /// shape is the judged one.
  bool on_nodes = false;

  std::size_t triangles() const {
    std::size_t out = 0;
    for (const TriangleMesh& mesh : meshes) out += mesh.triangles.size();
    return out;
  }
  std::size_t vertices() const {
    std::size_t out = 0;
    for (const TriangleMesh& mesh : meshes) out += mesh.vertices.size();
    return out;
  }
  /// The meshes of the first and second triangle of a pair. @pre fewer meshes than two are one
  std::array<std::size_t, 2> sides = {0, 1};
  std::size_t mesh_of(std::size_t side) const { return std::min(sides[side], meshes.size() - 1); }
};

/// @pre every mesh has a triangle, and all coordinates are finite
Snapshot snapshot_of(const CaseCandidate& candidate);

/// The bodies of a frame without their lattices and rest shapes; welded vertices become one.
CaseCandidate candidate_of(const Snapshot& snapshot);

/// Ids of two kept cells, of the first and of the second body.
using CellPair = std::array<std::uint32_t, 2>;

/// The two cells alone, for detectors that test mapped cells: each body is the 8 nodes of its cell
/// and one triangle between three of them, on lattice nodes; one candidate for every pair of such
/// triangles in the faces. @pre there are two bodies, which have lattices with these cells
std::vector<CaseCandidate> cell_candidates(const Snapshot& snapshot, const CellPair& cells);

/// A triangle of one of the meshes.
struct Piece {
  std::uint32_t mesh = 0, triangle = 0;
};

/// Only these triangles, in the order given, and only their vertices, in the order of the mesh.
CaseCandidate with_pieces(const CaseCandidate& candidate, const std::vector<Piece>& pieces);

/// All triangles, those of the first mesh first.
std::vector<Piece> pieces_of(const CaseCandidate& candidate);

/// The coordinates of all vertices, x, y, z after one another, those of the first mesh first.
std::vector<double> coordinates_of(const CaseCandidate& candidate);
/// The same meshes elsewhere. @pre as many coordinates as coordinates_of gives
CaseCandidate with_coordinates(CaseCandidate candidate, const std::vector<double>& coordinates);

/// Per triangle, in the order of pieces_of, what it really is: 2 with an area, 1 a segment, 0 a
/// point. Exact.
std::vector<int> dimensions_of(const CaseCandidate& candidate);

/// The meshes without this one. @pre there are three or more
CaseCandidate without_mesh(CaseCandidate candidate, std::size_t mesh);

/// Ids of two triangles, of the meshes CaseCandidate::sides.
using TrianglePair = std::array<std::uint32_t, 2>;

/// The distance of two meshes over the largest side of the box round both: how far apart they are,
/// whatever their scale. 0 where they touch. @pre each has a triangle, and uses all its vertices
double relative_gap(const TriangleMesh& first, const TriangleMesh& second);

/// True when no corner of either triangle lies in the plane of the other (and both have one): then
/// a contact of them is a crossing that a small move of any corner does not end. Exact.
bool in_general_position(const CaseCandidate& candidate, const Piece& first, const Piece& second);

}  // namespace contactcheck::reduce
