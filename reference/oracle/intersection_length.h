// The length that two triangles share: the weight of a pair, whose sum does not change when a mesh
// is refined.
#pragma once

#include <optional>

#include "reference/oracle/exact_predicates.h"

namespace contactcheck::oracle {

/// The diameter of the intersection of two closed triangles, in their units: the length of the
/// shared segment if they cross, 0 if they share one point or none. A degenerate triangle is
/// treated as a segment or a point. Defined for every finite input; off by less than 1e-9 of the
/// larger triangle's largest side.
double intersection_length(const TriangleCorners& p, const TriangleCorners& q);

/// The same in double, for two triangles that clearly cross or clearly miss each other's plane;
/// nothing if rounding could cause an error above 1e-9 of the size.
std::optional<double> crossing_length(const TriangleCorners& p, const TriangleCorners& q);

/// The same in rational arithmetic, rounded at the end. A few hundred times slower.
double exact_intersection_length(const TriangleCorners& p, const TriangleCorners& q);

}  // namespace contactcheck::oracle
