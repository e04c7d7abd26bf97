// Whether two triangles share a point, in exact integers: fast enough to check ten million pairs.
#pragma once

#include "reference/oracle/rational_geometry.h"

namespace contactcheck::oracle::rational {

/// The same answer as triangles_intersect, about ten times faster. Two closed triangles meet if an
/// edge of one meets the other. The edge is clipped by the linear equations and inequalities that
/// describe the other triangle; it meets the triangle if some of it remains. A degenerate triangle
/// is described as a segment or a point; there are no other special cases.
/// @pre all coordinates finite
bool triangles_intersect_by_clipping(const TriangleCorners& p, const TriangleCorners& q);

/// Whether the two closed triangles share a point off the segment from `from` to `to` (a point if
/// the two are equal). Their intersection is the hull of its extreme points; these lie on edges, so
/// clipping finds them all.
/// @pre all coordinates finite; the segment lies on both triangles
bool share_more_than(const Vec3& from, const Vec3& to, const TriangleCorners& p,
                     const TriangleCorners& q);

}  // namespace contactcheck::oracle::rational
