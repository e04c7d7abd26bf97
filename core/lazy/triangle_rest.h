// What core/lazy/embedded_patch.h assumes of each triangle of a surface at rest.
#pragma once

#include <vector>

#include "core/deform/body.h"

namespace contactcheck {

/// In doubles, with their rounding: whoever uses a bound leaves room for it. Names and definitions
/// are those of core/lazy/embedded_patch.h. Lengths are those of the mesh times rest_scale().
struct TriangleRest {
  double stretch = 1.0;   ///< c; infinite: it has no area
  double ratio = 1.0;     ///< k, the largest; infinite: it meets a neighbour beyond what they share
  double gap = 0.0;       ///< g; 0: it meets another, is a duplicate, or too many are about it
  double edge = 0.0;      ///< h
  double altitude = 0.0;  ///< a
};

/// The power of two that brings the largest |coordinate| at rest to at most 1 (above 2^-74 and
/// below 2^24 at the ends of what doubles hold): squares of lengths of about the body's size are
/// then far from the ends of their range. @pre vertices are finite
double rest_scale(const BodyShape& shape);

/// Of every triangle of the mesh at rest. Time: n log n, plus a bounded number of distances each.
std::vector<TriangleRest> triangles_at_rest(const BodyShape& shape);

}  // namespace contactcheck
