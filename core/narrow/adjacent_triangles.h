// Whether two triangles of one mesh share more than the corner or the edge that makes them
// neighbours: contact of a body with itself (fixtures/README.md, levels self-vertex, self-edge).
//
// Exact and closed, for all finite doubles. A degenerate triangle is the segment or the point that
// it is.
#pragma once

#include "core/narrow/triangle_triangle.h"
#include "core/types/shared_corners.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// True when the closed triangles (c, p1, p2) and (c, q1, q2) share a point other than c.
/// @pre all coordinates finite
bool meet_beyond_corner(const Vec3& c, const Vec3& p1, const Vec3& p2, const Vec3& q1,
                        const Vec3& q2);

/// True when the closed triangles (a, b, p) and (a, b, q) share a point beyond the segment a b.
/// @pre all coordinates finite
bool meet_beyond_edge(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q);

/// True when two different triangles of one mesh share a point off the hull of the vertices that
/// both name. False for duplicates, which are no contact. @pre all coordinates finite
bool meet_beyond_shared(const SharedCorners& shared, const TrianglePoints& p,
                        const TrianglePoints& q);

inline bool meet_beyond_shared(const SharedCorners& shared, const TrianglePointsOf<float>& p,
                               const TrianglePointsOf<float>& q) {
  return meet_beyond_shared(shared, in_doubles(p), in_doubles(q));
}

}  // namespace contactcheck
