// The penetration depth of two convex pieces, by brute force over the directions of all facets.
#pragma once

#include <span>

#include "reference/oracle/exact_predicates.h"
#include "reference/oracle/surface_geometry.h"

namespace contactcheck::oracle {

/// Unit directions that differ by less count as equal.
constexpr double kSameDirection = 1e-9;

/// Adds a unit direction unless a nearly equal one is in the list.
void add_direction(const Vec3& direction, std::vector<Vec3>& directions);

/// Triangles whose union is a convex piece's boundary, or the flat piece itself. Every edge of the
/// piece is a side of one. A segment or a point is a degenerate triangle.
using PieceSurface = std::span<const TriangleCorners>;

/// The shortest translation of piece `b` that leaves it at most touching piece `a`, off by less
/// than 1e-12 of the largest side of their joint box, and all directions in which the depth is
/// within `tolerance` of it. Pieces in one plane have depth 0 and the plane's normals. Pieces on
/// one line (or at one point) have infinitely many such directions; four (six) of them are given.
/// @pre the pieces share a point; at least one triangle each; all |coordinates| <= 1
Penetration convex_penetration(PieceSurface a, PieceSurface b, double tolerance);

}  // namespace contactcheck::oracle
