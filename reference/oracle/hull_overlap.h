// Whether the convex hulls of two sets of eight points share a point: exact, closed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/deform/lattice.h"
#include "core/types/vec3.h"
#include "reference/oracle/exact_predicates.h"

namespace contactcheck::oracle {

/// A convex hull, ready to be tested against others.
struct ConvexHull {
  std::vector<Vec3> points;  ///< the distinct ones
  Aabb box;
  /// Triangles whose union is the hull's boundary when it has volume, and the hull itself when it
  /// is flat. With volume, all points lie on the closed negative side of each.
  std::vector<TriangleCorners> surface;
  bool has_volume = false;
};

/// The hull of eight finite points, which may coincide, be collinear or coplanar.
ConvexHull make_hull(const Corners& corners);

/// True when the closed hulls share a point; exact.
bool hulls_overlap(const ConvexHull& a, const ConvexHull& b);

}  // namespace contactcheck::oracle
