// Exact, closed intersection test of two triangles.
#pragma once

#include <array>

#include "core/types/vec3.h"

namespace contactcheck {

template <typename T>
using TrianglePointsOf = std::array<Vec3Of<T>, 3>;
using TrianglePoints = TrianglePointsOf<double>;

/// True when the closed triangles share a point: touching counts, and a degenerate triangle is the
/// segment or the point that it is. Exact for all finite doubles (including denormal and huge
/// ones): a filter with a proven error bound answers first, else exact arithmetic does.
/// @pre all coordinates finite
bool triangles_intersect(const TrianglePoints& p, const TrianglePoints& q);

/// The same test with the signs of predicates_single.h: closed, the same bits on every instruction
/// set, but NOT exact. Where triangles come closer than the rounding of their determinants (about
/// 2^-20 of their size) it may say either, and may say something else for (q, p).
/// @pre |coordinates| at most kSingleLimit (local_origin.h)
bool triangles_intersect(const TrianglePointsOf<float>& p, const TrianglePointsOf<float>& q);

}  // namespace contactcheck
