// Triangles whose corners move straight over a step, and tests that see two of them apart for all
// of it. Both compare the two ends alone, with each other's places at the same time: a motion that
// two triangles share is not seen, whatever its speed.
#pragma once

#include <array>

#include "core/types/vec3.h"

namespace contactcheck {

/// Boxes at both ends of a step around points that move straight, and around all that is between
/// such points.
struct MovingBox {
  Aabb start, end;
  void extend(const Vec3& at_start, const Vec3& at_end) {
    start.extend(at_start);
    end.extend(at_end);
  }
};

/// True if one of the two lies beyond the other along an axis, on the same side at both ends. Then
/// no points of them meet at any time of the step: along that axis the coordinates at t are those
/// of both ends, weighted by 1 - t and t, and the two sides of a sharp inequality stay apart.
/// Exact, as nothing is computed.
inline bool separated(const MovingBox& a, const MovingBox& b) {
  for (int k = 0; k < 3; ++k) {
    if (a.start.hi[k] < b.start.lo[k] && a.end.hi[k] < b.end.lo[k]) return true;
    if (b.start.hi[k] < a.start.lo[k] && b.end.hi[k] < a.end.lo[k]) return true;
  }
  return false;
}

/// A triangle, degenerate or not, that points to its corners.
struct MovingTriangle {
  MovingTriangle(const std::array<const Vec3*, 3>& at_start,
                 const std::array<const Vec3*, 3>& at_end)
      : start(at_start), end(at_end) {
    for (std::size_t i = 0; i < 3; ++i) box.extend(*start[i], *end[i]);
  }
  std::array<const Vec3*, 3> start, end;
  MovingBox box;
};

/// The corners of two triangles at both ends, the start's first, less the second one's first corner
/// at that end.
struct RelativeCorners {
  RelativeCorners(const MovingTriangle& first, const MovingTriangle& second);
  std::array<Vec3, 6> p, q;  ///< of the first and the second triangle
  double farthest = 0.0;     ///< |coordinate|
};

/// The distance of two triangles along a direction, times its length.
struct Gap {
  double distance = 0.0;  ///< the smaller one of both ends, on the same side; below 0: overlap
  double error = 0.0;     ///< of `distance`, at most, but for the last rounding, 2^-53 of it
};
/// @pre `corners.farthest` and all |coordinates| of `normal` are at most 2^300 and 2^601
Gap gap_along(const Vec3& normal, const RelativeCorners& corners);

/// True if boxes, or a plane parallel to one of the triangles at the start, are seen to separate
/// the two triangles for the whole step. Where it is true they share no point at any time.
/// @pre finite corners
bool separated(const MovingTriangle& p, const MovingTriangle& q);

}  // namespace contactcheck
