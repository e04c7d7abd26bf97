// Proves that patches of a surface do not meet themselves in a frame, from the lattice nodes alone:
// no vertex is mapped for it.
//
// Claim: no two triangles of a patch share more than the vertices that both name.
//
// Terms. At rest the surface is a set of triangles in space. F is the trilinear map of the lattice,
// G what is judged: linear on each triangle between the mapped vertices. Q is the box of the patch
// at rest; the cells that Q meets are all kept, or at most two along each axis. A is any linear
// map, s its smallest singular value. In each of these cells that is kept, within Q: |DF - A| <= d
// (operator norm), and DF changes by at most m per length.
//
// Assumptions on the rest shape, by triangle (PatchRest, largest or smallest over the patch):
//   * stretch c: for a linear map of the triangle that stretches each edge by at most 1, the
//     stretch of any direction is at most c. With t the largest angle, c = 1 / cos(t / 2): every
//     direction lies between those of two edges, at an angle of at most t.
//   * ratio k: for points x, y of it and of a neighbour (that shares a vertex), a path over the two
//     triangles has length at most k |x - y|.
//   * gap g: all triangles that share no vertex with it are at least g away. It is at most the
//     longest edge h.
//   * altitude a, the smallest; longest edge h.
// Every cell that a triangle meets is kept. Mapped vertices are off by at most e each.
//
// Paths. For points x, y of Q in kept cells X, Y: |(F - A)(x) - (F - A)(y)| <= r d |x - y|, where
// r = 1 if all cells of Q are kept, or it meets no more than two, else r = sqrt(2).
//   1. Where X and Y are one cell or share a face, the segment x y lies in them.
//   2. Else they share an edge or corner. Let u + v be the part of y - x along the axes that
//      separate them, u up to the separating planes and v from there on: u . v >= 0, so
//      |u| + |v| <= sqrt(2) |u + v|. The path that is straight from x to the shared edge (or
//      corner), meets it at the fraction |u| / (|u| + |v|), and is straight from there to y, lies
//      in X, Y and Q, and has length at most sqrt(2) |x - y|.
//
// Neighbours. Let x and y be different points of two neighbours.
//   1. The edges of a triangle lie in kept cells: G - A stretches them by d, and any direction in
//      the triangle by L = c (d + 2 e / a).
//   2. Along the path over the two, |(G - A)(x) - (G - A)(y)| <= L k |x - y|.
//   3. G(x) and G(y) differ where s > k L.
//   4. Q in one cell: in the direction of an edge, DG is the mean of DF over that edge, and so off
//      DF at any point by at most m h; D(G - F) is at most c (m h + 2 e / a) in any direction. G(x)
//      and G(y) differ also where s > d + k c (m h + 2 e / a).
// Others. Let x and y be points of two triangles that share no vertex: |x - y| >= g.
//   1. |F(x) - F(y)| >= (s - r d) |x - y|.
//   2. For a point p of a triangle with corners v and barycentric coordinates w, the sum of
//      w (F(v) - F(p) - A (v - p)) is G(p) - F(p). So |G - F| <= d h / sqrt(3) + e, since the sum
//      of w |v - p|^2 is at most h^2 / 3.
//   3. Q in one cell: with DF(p) for A, |G - F| <= m h^2 / 6 + e.
//   4. G(x) and G(y) differ where (s - r d) g > 2 |G - F|.
//
// Where a triangle has no area, meets another at rest, or is a duplicate, c or k is infinite or g
// is 0, and nothing is claimed.
//
// Range. Lengths at rest are in the scale of the mesh (rest_scale) and mapped ones in that of the
// frame, so that bodies of any size have entries of DF near 1. Products are in doubles. What comes
// from squares of lengths below 2^-200, sides of cells outside [2^-100, 2^100], or a DF whose
// square is outside [2^-200, 2^200] is not used: there nothing is claimed.
//
// The claim is tested first for the cell, or the 2 x 2 x 2 cells, that contain a patch, with all
// triangles in them: once a frame, since many patches share them. Two patches are tested together
// only where the claim holds for each.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/deform/body.h"
#include "core/lazy/grid_places.h"
#include "core/lazy/lattice_tree.h"
#include "core/lazy/lazy_state.h"

namespace contactcheck {

/// Bounds, at rest, on the triangles below one child of a block, or below two. Lengths are in the
/// scale of the mesh (rest_scale).
struct PatchRest {
  std::array<double, 3> lo{}, hi{};                 ///< box of the triangles, exact, in metres
  GridIndex first_cell{}, last_cell{};              ///< of the cells that it meets
  float stretch = 0.0f, ratio = 0.0f, edge = 0.0f;  ///< not below c, k, h; or infinite
  float gap = 0.0f, altitude = 0.0f;                ///< not above g, a

  PatchRest united(const PatchRest& other) const {
    PatchRest out;
    for (int k = 0; k < 3; ++k) {
      out.lo[k] = std::min(lo[k], other.lo[k]);
      out.hi[k] = std::max(hi[k], other.hi[k]);
      out.first_cell[k] = std::min(first_cell[k], other.first_cell[k]);
      out.last_cell[k] = std::max(last_cell[k], other.last_cell[k]);
    }
    out.stretch = std::max(stretch, other.stretch);
    out.ratio = std::max(ratio, other.ratio);
    out.edge = std::max(edge, other.edge);
    out.gap = std::min(gap, other.gap);
    out.altitude = std::min(altitude, other.altitude);
    return out;
  }
};

/// The cells between two neighbouring grid lines. Lengths without a unit are in the scale of the
/// mesh.
struct GridSlice {
  double low = 0.0;       ///< metres
  double farthest = 0.0;  ///< |coordinate| of the lines
  double inverse = 0.0;   ///< 2 / side; 0: nothing is claimed for this side
};

/// Regions of one cell, or of 2 x 2 x 2 cells, each with all triangles inside it; none is empty.
struct PatchRegions {
  std::vector<PatchRest> patches;  ///< ascending in (z, y, x) of their lowest cell
  GridPlaces places;               ///< finds a region by that cell

  std::size_t bytes() const { return patches.capacity() * sizeof(PatchRest) + places.bytes(); }
};

struct PatchTree {
  std::vector<PatchRest> children;               ///< [block * kBlockWidth + lane]
  std::array<std::vector<GridSlice>, 3> slices;  ///< by axis
  PatchRegions ones, eights;                     ///< at most 1 and 8 per kept cell
  GridPlaces kept;                               ///< finds kept cells
  double scale = 1.0;                            ///< factor on lengths at rest (rest_scale)

  /// Bytes held, for the report.
  std::size_t bytes() const;
};

/// @pre the shape has a lattice, and `tree` was made from it
PatchTree make_patch_tree(const BodyShape& shape, const LatticeTree& tree);

/// True only if the claim is proven in this frame for the patch below `a`, or below `a` and `b`
/// together (indices of PatchTree::children). @pre find_cells() was called; `state`, which caches
/// results, is used by one thread
bool stays_embedded(LazyState& state, const PatchTree& patches, std::uint32_t a, std::uint32_t b);

}  // namespace contactcheck
