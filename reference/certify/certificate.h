// Proofs about one pair of closed triangles that anybody can check with exact arithmetic: a common
// point, or a plane between the two. Degenerate triangles are the segment or the point that they
// are. Constructed in rational arithmetic of this layer's own, so that a wrong verdict of the
// oracle leaves nothing to write down.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>

#include "reference/oracle/exact_predicates.h"

namespace contactcheck::certify {

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

/// Nothing when the triangles share no point. @pre all coordinates finite, of both functions
std::optional<Witness> common_point(const oracle::TriangleCorners& p,
                                    const oracle::TriangleCorners& q);
/// Nothing when they share one; exactly one of the two functions answers.
std::optional<Plane> separating_plane(const oracle::TriangleCorners& p,
                                      const oracle::TriangleCorners& q);

}  // namespace contactcheck::certify
