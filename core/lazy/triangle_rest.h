// What core/lazy/embedded_patch.h assumes of each triangle of a surface at rest.
#pragma once

#include <vector>

#include "core/deform/body.h"

namespace contactcheck {

/// In doubles, with their rounding: whoever uses a bound leaves room for it. Names and definitions
/// are those of core/lazy/embedded_patch.h.
struct TriangleRest {
  double stretch = 1.0;   ///< c; infinite: it has no area
  double ratio = 1.0;     ///< k, the largest; infinite: it meets a neighbour beyond what they share
  double gap = 0.0;       ///< g; 0: it meets another, is a duplicate, or too many are about it
  double edge = 0.0;      ///< h
  double altitude = 0.0;  ///< a
};

/// Of every triangle of the mesh at rest. Time: n log n, plus a bounded number of distances each.
std::vector<TriangleRest> triangles_at_rest(const BodyShape& shape);

}  // namespace contactcheck
