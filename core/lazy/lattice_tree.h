// The hierarchy that the lazy detector descends: built once at rest, shared by all instances.
//
// Leaves have up to kLeafTriangles triangles. A block is a node with up to eight children that are
// bounded together from the deformed lattice nodes alone; no vertex is mapped for it. Triangles are
// grouped by the cell that owns them (the home cell of most of their vertices), so that children
// span few cells.
//
// Claim: the bounds of a child contain every vertex of its triangles, and the triangles.
//
// Assumptions:
//   * A vertex lies in its home cell with local coordinates x in [0, 1]^3. Its exact image is the
//     trilinear blend of the cell's eight nodes. (bounds-inl.h adds the rounding errors.)
//   * A piece is what a child has in one home cell. It bounds y = 2 x - 1 over those vertices:
//     d = y - c has |d| <= e along each axis, with a middle c and half-widths e.
//
// Box:
//   * A function that is trilinear in the cell is, about c,
//       f(y) = f(c) + g.d + f_st ds dt + f_su ds du + f_tu dt du + f_stu ds dt du
//   * So |f(y) - f(c)| <= |g|.e + |f_st| es et + |f_su| es eu + |f_tu| et eu + |f_stu| es et eu.
//   * Each coordinate is such a function. A child's box is the union over its pieces.
//
// Slab, across the surface of the child:
//   * m is a covector of local coordinates, normal to the surface at rest. Over the vertices of a
//     piece a <= m.y <= b.
//   * For any direction n in the world, f = n . X is trilinear.
//   * For any k, g.d = k m.d + (g - k m).d. The first term lies between k (a - m.c) and
//     k (b - m.c), the second within |g - k m|.e.
//   * With the mixed terms as for the box, this bounds f. It is tight where g is nearly parallel to
//     m, which holds for n normal to the deformed surface.
//
// Triangles:
//   * Deformed triangles are flat between mapped vertices. A convex set with the three vertices
//     contains the triangle, also where it crosses a displaced cell that contains none of them.
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
#include "core/types/semantics.h"

namespace contactcheck {

inline constexpr std::uint32_t kLeafTriangles = 16;
inline constexpr std::uint32_t kBlockWidth = 8;
/// Elements that a vector load may read beyond the last one of a leaf.
inline constexpr std::uint32_t kLeafPadding = 8;

/// Child of a block: a leaf or another block.
struct TreeChild {
  static constexpr std::uint32_t kLeaf = std::uint32_t{1} << 31;
  std::uint32_t value = 0;
  bool leaf() const { return (value & kLeaf) != 0; }
  std::uint32_t index() const { return value & ~kLeaf; }
};

/// Eight pieces of the children of a block, one per SIMD lane: each what a child has in one of its
/// home cells. Bounds of y = 2 x - 1 are quantised outward to steps that floats represent.
struct PieceLanes {
  static constexpr double kSteps = 0x1p14;  ///< steps per unit of y
  std::array<std::uint32_t, kBlockWidth> cell{};
  std::array<std::uint8_t, kBlockWidth> child{};
  std::array<std::array<std::int16_t, kBlockWidth>, 3> lo{}, hi{};  ///< per axis
  std::array<float, kBlockWidth> slab_lo{}, slab_hi{};              ///< bounds of m.y, outward
};

/// Per child of a block: the normal m of its surface at rest, in local coordinates.
struct BlockSlabs {
  static constexpr double kNormalSteps = 127.0;  ///< steps of the largest component
  std::array<std::array<std::int8_t, kBlockWidth>, 3> normal{};
};

struct TreeBlock {
  std::array<TreeChild, kBlockWidth> child{};
  std::uint32_t children = 0;
  /// Range in `pieces`. Lanes of the first are the children in order, each with the home cell of
  /// most of its vertices; the others follow as they come. Lanes left over repeat lane 0.
  std::uint32_t begin = 0, end = 0;
};

struct TreeLeaf {
  std::uint32_t first_triangle = 0;  ///< in leaf_triangles
  std::uint32_t first_vertex = 0;    ///< in leaf_vertices and leaf_local
  std::uint32_t first_run = 0;       ///< in runs
  std::uint16_t triangles = 0, vertices = 0, runs = 0;
};

/// [corner][triangle]: the index of that corner among the leaf's vertices.
using LeafCorners = std::array<std::array<std::uint8_t, kLeafTriangles>, 3>;

/// A contiguous run of a leaf's vertices: those with the home cell `cell`.
struct VertexRun {
  std::uint32_t cell = 0;
  std::uint32_t count = 0;
};

struct LatticeTree {
  std::vector<TreeBlock> blocks;   ///< [0] is the root; a child has a higher index than its parent
  std::vector<PieceLanes> pieces;  ///< with a lattice
  std::vector<BlockSlabs> slabs;   ///< with a lattice, per block

  std::vector<TreeLeaf> leaves;
  std::vector<std::uint32_t> leaf_triangles;      ///< index in the mesh
  std::vector<LeafCorners> leaf_corners;          ///< per leaf
  std::vector<std::uint32_t> leaf_vertices;       ///< index in the mesh, and padding
  std::vector<VertexRun> runs;                    ///< with a lattice
  std::array<std::vector<double>, 3> leaf_local;  ///< with a lattice: s, t, u, and padding
  /// Replace leaf_local in single precision: rounded; for kVertices in order of the batch mapping.
  std::array<std::vector<float>, 3> single_leaf_local;
  SingleLocal single_sorted_local;

  /// Bytes held, for the report.
  std::size_t bytes() const;
};

enum class TreeUse {
  kNodes,    ///< bounded from lattice nodes
  kVertices  ///< refitted to vertices: topology alone, as without a lattice
};

/// @pre the shape has triangles
LatticeTree make_lattice_tree(const BodyShape& shape, TreeUse use = TreeUse::kNodes,
                              Precision precision = Precision::kDouble);

}  // namespace contactcheck
