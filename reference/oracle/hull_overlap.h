// Whether the closed convex hulls of two sets of eight points share a point: exact.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/deform/lattice.h"
#include "core/types/vec3.h"
#include "reference/oracle/exact_predicates.h"

namespace contactcheck::oracle {

/// A convex hull, prepared for tests against others.
struct ConvexHull {
  std::vector<Vec3> points;  ///< the distinct ones
  Aabb box;
  /// Triangles whose union is the hull's boundary if it has volume, and the hull itself if it is
  /// flat. With volume, all points lie on the closed negative side of each triangle.
  std::vector<TriangleCorners> surface;
  bool has_volume = false;
};

/// The hull of eight finite points, which may coincide, be collinear or coplanar.
ConvexHull make_hull(const Corners& corners);

/// True when the closed hulls share a point; exact.
bool hulls_overlap(const ConvexHull& a, const ConvexHull& b);

}  // namespace contactcheck::oracle
