// Whether closed triangles, segments and points share a point: exact for every finite input.
//
// Touching counts, and there is no epsilon. A degenerate triangle is treated as a segment or a
// point, a segment with equal ends as a point.
#pragma once

#include "core/types/mesh.h"
#include "core/types/vec3.h"
#include "reference/oracle/exact_predicates.h"

namespace contactcheck::oracle {

struct Segment {
  Vec3 from, to;
};

bool point_on_segment(const Vec3& point, const Segment& segment);
bool point_on_triangle(const Vec3& point, const TriangleCorners& triangle);
bool segments_intersect(const Segment& p, const Segment& q);
bool segment_meets_triangle(const Segment& segment, const TriangleCorners& triangle);
bool triangles_intersect(const TriangleCorners& p, const TriangleCorners& q);

/// True when two triangles share a point other than the corner p[0] = q[0].
bool meet_beyond_corner(const TriangleCorners& p, const TriangleCorners& q);
/// True when two triangles share a point off the segment from p[0] = q[0] to p[1] = q[1].
bool meet_beyond_edge(const TriangleCorners& p, const TriangleCorners& q);

/// True when two triangles of one body share more than the hull of the vertices that both use;
/// false for duplicates.
bool meet_beyond_shared(const Triangle& p, const TriangleCorners& p_corners, const Triangle& q,
                        const TriangleCorners& q_corners);

/// The segment (or point) of a degenerate triangle, between its outermost corners.
/// @pre the corners are collinear
Segment segment_of_degenerate(const TriangleCorners& triangle);

}  // namespace contactcheck::oracle
