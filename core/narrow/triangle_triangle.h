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

inline TrianglePoints in_doubles(const TrianglePointsOf<float>& t) {
  return {t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>()};
}

/// The same test of floats, equally exact: every float is a double.
inline bool triangles_intersect(const TrianglePointsOf<float>& p,
                                const TrianglePointsOf<float>& q) {
  return triangles_intersect(in_doubles(p), in_doubles(q));
}

}  // namespace contactcheck
