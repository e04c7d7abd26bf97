// Exact, closed intersection test of two triangles.
#pragma once

#include <array>

#include "core/types/vec3.h"

namespace contactcheck {

using TrianglePoints = std::array<Vec3, 3>;

/// True when the closed triangles share a point: touching counts, and a degenerate triangle is the
/// segment or the point that it is. Exact for all finite doubles (including denormal and huge
/// ones): a filter with a proven error bound answers first, else exact arithmetic does.
/// @pre all coordinates finite
bool triangles_intersect(const TrianglePoints& p, const TrianglePoints& q);

}  // namespace contactcheck
