// How much two triangles share: the weight of a pair, which a finer mesh splits but does not
// change.
#pragma once

#include <optional>

#include "reference/oracle/exact_predicates.h"

namespace contactcheck::oracle {

/// The diameter of the intersection of two closed triangles, in their units; of two that cross, the
/// length of the segment that they share; 0 where they share one point or none. Degenerate
/// triangles are the segment or the point that they are. Every finite input; off by less than 1e-9
/// of the larger triangle's largest side.
double intersection_length(const TriangleCorners& p, const TriangleCorners& q);

/// The same in double, for two triangles that clearly cross or clearly miss each other's plane;
/// nothing where rounding could tell more than 1e-9 of the size.
std::optional<double> crossing_length(const TriangleCorners& p, const TriangleCorners& q);

/// The same in rational arithmetic, rounded at the end. Some hundred times slower.
double exact_intersection_length(const TriangleCorners& p, const TriangleCorners& q);

}  // namespace contactcheck::oracle
