// What the FFD-AABB family prepares once per shape: which boxes stand for which cell, which
// triangles a cell answers for, and the spheres above them.
//
// Reading `paper`: each kept cell has one box (the cell, or its FFD-AABB) and answers for the
// triangles labelled with it.
//
// Reading `safe`: each triangle has one owner, the home cell of most of its vertices (of its first
// vertex where all three differ). An owner cell has one box per home cell in which vertices of its
// triangles lie: the bounds of their local coordinates there (or that whole cell, for ffd-grid).
//
// Claim: the bounds of an owner's boxes contain every triangle that it owns, whichever cells the
// triangle's vertices lie in, also across a displaced cell that contains none of them. Bounds are
//   * an AABB of all corners of the boxes, moved out by 2 e (and e for its own rounding), and
//   * a ball that contains all these corners, enlarged by 2 sqrt(3) e.
//
// Assumptions:
//   * v is a vertex of an owned triangle, in home cell H with local coordinates x, and B the
//     owner's box in H. B.lo <= x <= B.hi holds between the stored numbers.
//   * Computed images differ from exact ones by at most e = mapping_error_bound() per coordinate,
//     of vertices and of corners alike.
//
// Steps:
//   1. The trilinear map of H restricted to B is the trilinear blend of the exact images of B's
//      eight corners, with weights in [0, 1] that sum to 1. So the exact image of v lies in their
//      convex hull.
//   2. The computed image of v is within e of its exact image, and a computed corner within e of
//      its own. So the computed image of v lies within 2 e, per coordinate, of the hull of the
//      computed corners: within 2 sqrt(3) e in distance.
//   3. An AABB or ball round all computed corners contains this hull. Enlarged so, it contains v.
//   4. A deformed triangle is flat between mapped vertices. So it lies inside any convex set that
//      contains the three.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/broad/sphere_tree.h"
#include "core/deform/body.h"
#include "core/deform/mapping.h"
#include "core/detect/ffd_config.h"

namespace contactcheck {

/// A box in local coordinates of `home` that belongs to an (owner or kept) cell.
struct FfdPiece {
  std::uint32_t cell = 0;
  std::uint32_t home = 0;
  Aabb local;
};

/// Compressed rows: the items of row r are values[begin[r]] .. values[begin[r + 1]].
struct Rows {
  std::vector<std::uint32_t> begin, values;
  std::span<const std::uint32_t> row(std::uint32_t r) const {
    return std::span(values).subspan(begin[r], begin[r + 1] - begin[r]);
  }
};

/// The part of a model that does not depend on the precision.
struct FfdStructure {
  const BodyShape* shape = nullptr;
  std::vector<FfdPiece> pieces;            ///< ascending by cell
  std::vector<std::uint32_t> piece_begin;  ///< per kept cell, size + 1
  std::vector<std::uint32_t> cells;        ///< cells that have pieces
  Rows triangles;                          ///< per kept cell: labelled (paper) or owned (safe)
  std::vector<std::uint32_t> owner;        ///< per triangle; safe only
  Rows node_cells;                         ///< per lattice node: the kept cells around it
  SphereTree spheres;                      ///< without spheres it has no levels
  double mean_edge = 0.0;  ///< metres, at rest: of the boxes (paper), of owners' AABBs (safe)

  std::span<const FfdPiece> pieces_of(std::uint32_t cell) const {
    return std::span(pieces).subspan(piece_begin[cell], piece_begin[cell + 1] - piece_begin[cell]);
  }
};

/// The numbers that a frame is computed from, in the precision of the detector.
template <typename T>
struct FfdModelOf : FfdStructure {
  std::vector<LocalBoxOf<T>> piece_boxes;   ///< the boxes of the pieces, for map_boxes
  std::vector<std::vector<T>> rest_radius;  ///< per level and sphere, metres
};
using FfdModel = FfdModelOf<double>;

/// The same model with its numbers rounded once. Rounding is monotone: the safe reading's boxes
/// contain the rounded local coordinates of their vertices as they contained the doubles.
FfdModelOf<float> rounded_model(FfdModel model);

/// @throws RefusedInput when the shape has no lattice, or a count exceeds what 32 bits can number
FfdModel make_ffd_model(const BodyShape& shape, const FfdConfig& config);

}  // namespace contactcheck
