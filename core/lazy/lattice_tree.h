// The hierarchy that the lazy detector descends: built once at rest, shared by all instances.
//
// Leaves hold up to kLeafTriangles triangles. A block is a node with up to eight children that are
// bounded together, one per SIMD lane, from the deformed lattice nodes alone; no vertex is mapped
// for it. Triangles are grouped by the cell that owns them (the home cell of most of their
// vertices), so that most blocks lie in one cell.
//
// Why the bounds contain every mapped vertex. A vertex v of a child lies in its home cell h, with
// local coordinates x in [0, 1]^3, and its exact image is the trilinear blend of h's eight nodes.
// A child is bounded in one of two ways.
//   Pieces: for every home cell h of its vertices, the bounds of their x in h. About the middle of
//   such a box each coordinate is its value there, its gradient times d, and the mixed terms below
//   (with no slab: g.d within |g| e). The child's box is the union over its home cells.
//   Hulls, for children that span many cells: all nodes of the cells that own its triangles, and
//   for each vertex with another home h the way from there: some owner cell o of the child shares a
//   face, edge or node with h. Moving x in h, axis by axis, to what they share changes the image by
//   (distance in local units) times a blend of h's four edges along that axis, and ends in the hull
//   of o's nodes. So the hull, widened per axis by the largest such distance times the largest edge
//   of the body along that axis (by component), holds the image. Where owner and home share no
//   node, h's nodes are added as a whole.
// Children bounded by pieces have a slab too, across their surface. At rest the vertices lie
// between two planes normal to m, a covector of local coordinates: a <= m.x <= b in each home cell.
// For any direction n in the world, f = n . X is trilinear in x, so about the centre c of the
// piece, with d = x - c and half-widths e,
//   f(x) = f(c) + g.d + f_st ds dt + f_su ds du + f_tu dt du + f_stu ds dt du,
// and g.d = k m.d + (g - k m).d for any k: an interval from [a, b] and e. It is tight where g is
// nearly parallel to m, which holds for n normal to the deformed surface.
// Deformed triangles are flat between mapped vertices: a convex set that holds the three holds the
// triangle, also where it crosses a displaced cell that holds none of its vertices.
//
// Source of the idea, lazily evaluated bounds of a free-form deformation: the project's feasibility
// study; Larsson and Akenine-Moeller, Collision Detection for Continuously Deforming Bodies, 2001,
// for laziness.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/deform/body.h"

namespace contactcheck {

inline constexpr std::uint32_t kLeafTriangles = 16;
inline constexpr std::uint32_t kBlockWidth = 8;
/// Vector loads may read this many elements beyond the last one of a leaf.
inline constexpr std::uint32_t kLeafPadding = 8;

/// Child of a block: a leaf or another block.
struct TreeChild {
  static constexpr std::uint32_t kLeaf = std::uint32_t{1} << 31;
  std::uint32_t value = 0;
  bool leaf() const { return (value & kLeaf) != 0; }
  std::uint32_t index() const { return value & ~kLeaf; }
};

/// Bounds of local coordinates in one home cell, of eight children: quantised outward to steps of
/// 2^-15, which floats represent.
struct HomePieces {
  static constexpr double kSteps = 0x1p15;
  std::uint32_t cell = 0;
  std::uint32_t children = 0;                                        ///< bit mask: which have any
  std::array<std::array<std::uint16_t, kBlockWidth>, 3> lo{}, hi{};  ///< per axis and child
  std::array<float, kBlockWidth> slab_lo{}, slab_hi{};  ///< of m.x, outward; see BlockSlabs
};

/// Per child of a block bounded by pieces: the normal m of its surface at rest, in local
/// coordinates.
struct BlockSlabs {
  static constexpr double kNormalSteps = 127.0;  ///< of the largest component
  std::array<std::array<std::int8_t, kBlockWidth>, 3> normal{};
};

struct TreeBlock {
  std::array<TreeChild, kBlockWidth> child{};
  std::uint32_t children = 0;
  bool hull = false;  ///< bounded by hulls, else by pieces
  /// Range in `pieces`, one per home cell, that of most vertices first; of a hull in `hulls`, one
  /// per child.
  std::uint32_t begin = 0, end = 0;
  std::uint32_t slabs = 0;  ///< index in `slabs`, unless a hull
};

struct HullChild {
  std::uint32_t node_begin = 0, node_end = 0;  ///< range in hull_nodes
  /// Per axis: how far vertices with another home than the child's owner cells lie from these, in
  /// local units.
  std::array<float, 3> reach{};
};

/// Two nodes next to one another along an axis.
struct LatticeEdge {
  std::uint32_t from = 0, to = 0;
};

struct TreeLeaf {
  std::uint32_t first_triangle = 0;  ///< in leaf_triangles
  std::uint32_t first_vertex = 0;    ///< in leaf_vertices and leaf_local
  std::uint32_t first_run = 0;       ///< in runs
  std::uint16_t triangles = 0, vertices = 0, runs = 0;
};

/// Per corner of its triangles: which of the leaf's vertices it is.
using LeafCorners = std::array<std::array<std::uint8_t, kLeafTriangles>, 3>;

/// Vertices of a leaf with one home cell stand together.
struct VertexRun {
  std::uint32_t cell = 0;
  std::uint32_t count = 0;
};

struct LatticeTree {
  std::vector<TreeBlock> blocks;  ///< [0] is the root; a child has a higher index than its parent
  std::vector<HomePieces> pieces;
  std::vector<BlockSlabs> slabs;
  std::vector<HullChild> hulls;
  std::vector<std::uint32_t> hull_nodes;
  std::array<std::vector<LatticeEdge>, 3> edges;  ///< of kept cells, per axis, each once

  std::vector<TreeLeaf> leaves;
  std::vector<std::uint32_t> leaf_triangles;      ///< index in the mesh
  std::vector<LeafCorners> leaf_corners;          ///< per leaf
  std::vector<std::uint32_t> leaf_vertices;       ///< index in the mesh, and padding
  std::array<std::vector<double>, 3> leaf_local;  ///< with a lattice: s, t, u, and padding
  std::vector<VertexRun> runs;                    ///< with a lattice

  /// Bytes held, for the report.
  std::size_t bytes() const;
};

enum class TreeUse {
  kNodes,    ///< bounded from lattice nodes
  kVertices  ///< refitted to vertices: topology alone, as without a lattice
};

/// @pre the shape has triangles
LatticeTree make_lattice_tree(const BodyShape& shape, TreeUse use = TreeUse::kNodes);

}  // namespace contactcheck
