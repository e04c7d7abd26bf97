// The world scale at which Bullet sees a scene's triangles: shared by the adapters of Bullet.
//
// Bullet 3.24 in single precision holds absolute limits in world units: a triangle whose
// |cross product of two edges|^2 is not above SIMD_EPSILON is no triangle to its projections
// (LinearMath/btScalar.h, November 2026). A mesh of unit size is full of those.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/deform/body.h"

namespace contactcheck {

/// Twice the area of the smallest rest triangle of a mesh that is no sliver: that has at least
/// 1e-6 of the median area of its own mesh's triangles. Triangles without area (as doubles compute
/// it) count for nothing. Square metres; infinity for a mesh without any other.
inline double smallest_doubled_area(const TriangleMesh& mesh) {
  std::vector<double> doubled_areas;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 u = mesh.vertices[t[1]] - mesh.vertices[t[0]];
    const Vec3 v = mesh.vertices[t[2]] - mesh.vertices[t[0]];
    const double doubled_area = u.cross(v).stableNorm();
    if (doubled_area > 0.0) doubled_areas.push_back(doubled_area);
  }
  if (doubled_areas.empty()) return std::numeric_limits<double>::infinity();
  std::sort(doubled_areas.begin(), doubled_areas.end());
  const double sliver = 1e-6 * doubled_areas[doubled_areas.size() / 2];
  return *std::lower_bound(doubled_areas.begin(), doubled_areas.end(), sliver);
}

/// World units per metre: the smallest power of two, at least 1 and at most 2^20, at which the
/// smallest rest triangle of every body (slivers apart) has |cross|^2 >= 64 * SIMD_EPSILON, so that
/// it may shrink to an eighth of its area while it deforms. A power of two adds no rounding to the
/// coordinates. Reaching 2^20 leaves triangles that Bullet cannot see.
inline double automatic_bullet_scale(const std::vector<Body>& bodies) {
  const double needed = 8.0 * std::sqrt(1.1920929e-7);  // |cross| in square world units
  const double limit = 1048576.0;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Body& body : bodies)
    smallest = std::min(smallest, smallest_doubled_area(body.shape->mesh));
  double scale = 1.0;
  while (scale < limit && !(scale * scale * smallest >= needed)) scale *= 2.0;
  return scale;
}

}  // namespace contactcheck
