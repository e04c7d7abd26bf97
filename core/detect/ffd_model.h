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
// Why that is safe. Let v be a vertex of an owned triangle, in home cell H with local coordinates
// x, and B the owner's box in H: B.lo <= x <= B.hi holds between the stored doubles. The trilinear
// map of H restricted to B is the trilinear blend of the images of B's eight corners with weights
// in [0, 1] that sum to 1, so the exact image of v lies in their convex hull. Computed images
// differ from exact ones by at most e = mapping_error_bound() per coordinate, for v and for the
// corners alike: v's computed image lies within 2 e (per coordinate) of the hull of the computed
// corners. Deformed triangles are flat between mapped vertices, hence inside any convex set that
// holds the three. So an AABB of all corners of an owner's boxes, moved out by 2 e, and a ball that
// holds all these corners, enlarged by 2 sqrt(3) e, contain every owned triangle, whichever cells
// its vertices lie in: also across a displaced cell that holds none of them.
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

/// What a model has whatever the precision.
struct FfdStructure {
  const BodyShape* shape = nullptr;
  std::vector<FfdPiece> pieces;            ///< ascending by cell
  std::vector<std::uint32_t> piece_begin;  ///< per kept cell, size + 1
  std::vector<std::uint32_t> cells;        ///< cells that have pieces
  Rows triangles;                          ///< per kept cell: labelled (paper) or owned (safe)
  std::vector<std::uint32_t> owner;        ///< per triangle; safe only
  Rows node_cells;                         ///< per lattice node: the kept cells around it
  SphereTree spheres;                      ///< no levels without spheres
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
/// hold the rounded local coordinates of their vertices as they held the doubles.
FfdModelOf<float> rounded_model(FfdModel model);

/// @throws RefusedInput when the shape has no lattice
FfdModel make_ffd_model(const BodyShape& shape, const FfdConfig& config);

}  // namespace contactcheck
