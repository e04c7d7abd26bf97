// A certified interval of the distance between two surfaces.
#pragma once

#include "reference/oracle/oracle.h"
#include "reference/oracle/surface_tree.h"

namespace contactcheck::oracle {

/// The vertices of a surface as they are, and scaled for arithmetic in double.
struct ScaledSurface {
  SurfaceTree* tree = nullptr;
  std::span<const Vec3> vertices;
  std::vector<Vec3> scaled;  ///< work space, kept for its capacity
};

/// The interval of DistanceInterval's contract: [0, 0] exactly when a triangle of one shares a
/// point with a triangle of the other (exact), else at most 1e-9 times the largest |coordinate|
/// wide. Leaves both trees fitted to the scaled vertices.
DistanceInterval surface_distance(ScaledSurface& a, ScaledSurface& b);

/// That of each of the points, as a surface of its own, to the surface; `triangles` names the
/// surface's second. Points that do not exceed the surface's coordinates share one fit of its tree.
std::vector<DistanceInterval> point_distances(std::span<const Vec3> points, ScaledSurface& surface);

}  // namespace contactcheck::oracle
