// The penetration depth of two convex pieces, by brute force over the directions of all facets.
#pragma once

#include <span>

#include "reference/oracle/exact_predicates.h"
#include "reference/oracle/surface_geometry.h"

namespace contactcheck::oracle {

/// Directions that differ by less are one.
constexpr double kSameDirection = 1e-9;

/// Adds a unit direction unless one that is nearly the same is there.
void add_direction(const Vec3& direction, std::vector<Vec3>& directions);

/// Triangles whose union is the boundary of a convex piece, or the piece itself where it is flat,
/// such that every edge of the piece is a side of one; a segment or a point is a degenerate one.
using PieceSurface = std::span<const TriangleCorners>;

/// The shortest translation of piece `b` that leaves it at most touching piece `a`, off by less
/// than 1e-12 of the largest side of the box round both, and all directions in which the depth is
/// within `tolerance` of that. Where the two lie in one plane: depth 0 and the plane's normals; on
/// one line (or at one point), where directions without number would do: four (six).
/// @pre the pieces share a point; at least one triangle each; all |coordinates| <= 1
Penetration convex_penetration(PieceSurface a, PieceSurface b, double tolerance);

}  // namespace contactcheck::oracle
