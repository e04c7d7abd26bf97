// Proofs about one pair of closed triangles that anybody can check with exact arithmetic: a common
// point, or a plane between the two. Degenerate triangles are the segment or the point that they
// are. Constructed in rational arithmetic of this layer's own, so that a wrong verdict of the
// oracle leaves nothing to write down.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "core/types/vec3.h"
#include "reference/oracle/exact_predicates.h"

namespace contactcheck::oracle::certify {

/// A common point, as weights of the corners of either triangle: integers, not negative, with a
/// positive sum, in hexadecimal digits ("1f"). The point is the sum of the corners times their
/// weights over the sum of the weights.
struct Witness {
  std::array<std::string, 3> p, q;
};

/// A finite double, or, where none serves, a rational: an integer or two with '/' between them, in
/// hexadecimal digits ("-1f/20").
using ExactNumber = std::variant<double, std::string>;

/// normal * x <= offset for the corners x of p, > offset for those of q.
struct Plane {
  std::array<ExactNumber, 3> normal;
  ExactNumber offset;
};

/// The corners are not on one line.
bool is_proper(const TriangleCorners& t);

/// Nothing when the triangles share no point. @pre all coordinates finite, of all three functions
std::optional<Witness> common_point(const TriangleCorners& p, const TriangleCorners& q);
/// Nothing when they share one; exactly one of the two functions answers.
std::optional<Plane> separating_plane(const TriangleCorners& p, const TriangleCorners& q);

/// A point of either triangle, as near to one another as the triangles are; each coordinate cut to
/// a double.
std::array<Vec3, 2> nearest_points_rounded(const TriangleCorners& p, const TriangleCorners& q);

/// A common point of two triangles of one mesh, off the hull of the corners they share, which come
/// first in both. Nothing when there is none. @pre 1 or 2 are shared, and stand at the same places
std::optional<Witness> further_point(const TriangleCorners& p, const TriangleCorners& q,
                                     std::uint32_t shared);
/// A plane through the one corner that two triangles share, the first of both: p is on one closed
/// side, q on the other, and the two other corners of p, or of q, are off it. Then that corner is
/// all they share. Nothing when they share more. @pre not both are segments
std::optional<Plane> plane_through_corner(const TriangleCorners& p, const TriangleCorners& q);
/// Whether two triangles share only the hull of the corners they share. A checker does the few
/// products itself. @pre they share an edge, or both are segments
bool share_hull_alone(const TriangleCorners& p, const TriangleCorners& q, std::uint32_t shared);

}  // namespace contactcheck::oracle::certify
