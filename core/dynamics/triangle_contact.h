// How two triangles in contact are to be separated: one direction, one depth, one point on each.
// Guarantee: swapping the triangles flips the normal and changes nothing else, up to rounding. No
// verdict depends on it.
#pragma once

#include <array>

#include "core/narrow/triangle_triangle.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// Weights of a triangle's corners: not negative, with sum 1 up to rounding.
using Barycentric = std::array<double, 3>;

struct TriangleContact {
  /// Unit, from a to b; zero where the triangles give no direction: neither has a plane, or both
  /// face the same way, and their centroids coincide.
  Vec3 normal = Vec3::Zero();
  double depth = 0.0;  ///< metres, not negative, at most the longest edge of the smaller triangle
  Barycentric on_a = {}, on_b = {};  ///< where they cross, or nearest to it
};

/// Normal: the difference of the outward normals; a triangle without area gives none. Depth: the
/// smaller of the two distances by which one reaches behind the plane of the other.
/// @pre coordinates are finite and below 1e50 in magnitude (products of four of them are formed)
TriangleContact triangle_contact(const TrianglePoints& a, const TrianglePoints& b);

/// The point of a triangle nearest to `point`; of a degenerate triangle, of the segment or point
/// that it is.
Barycentric nearest_on_triangle(const Vec3& point, const TrianglePoints& triangle);

}  // namespace contactcheck
