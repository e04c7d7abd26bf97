// Measures what core/lazy/embedded_patch.h assumes of each triangle of a surface at rest.
#pragma once

#include <vector>

#include "core/deform/body.h"

namespace contactcheck {

/// Computed in doubles: users of a bound leave room for rounding. Names and definitions are from
/// core/lazy/embedded_patch.h. Lengths are those of the mesh times rest_scale().
struct TriangleRest {
  double stretch = 1.0;   ///< c; infinite: it has (almost) no area
  double ratio = 1.0;     ///< k, the largest; infinite: it meets a neighbour beyond what they share
  double gap = 0.0;       ///< g; 0: it meets another, is a duplicate, or too many are about it
  double edge = 0.0;      ///< h
  double altitude = 0.0;  ///< a
};

/// The power of two that brings the largest |coordinate| at rest into [1/2, 1), or as near as
/// scale_to_one() allows: squares of lengths of about the body's size are then far from the ends of
/// the range of doubles. @pre vertices are finite
double rest_scale(const BodyShape& shape);

/// Measures all triangles of the mesh at rest. Time: n log n, plus a bounded number of distances
/// per triangle.
std::vector<TriangleRest> triangles_at_rest(const BodyShape& shape);

}  // namespace contactcheck
