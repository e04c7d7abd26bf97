// The distance between two surfaces, as a certified interval.
#pragma once

#include "reference/oracle/oracle.h"
#include "reference/oracle/surface_tree.h"

namespace contactcheck::oracle {

/// The vertices of a surface, original and scaled for double arithmetic.
struct ScaledSurface {
  SurfaceTree* tree = nullptr;
  std::span<const Vec3> vertices;
  std::vector<Vec3> scaled;  ///< work space, kept for its capacity
};

/// The interval as DistanceInterval promises: [0, 0] exactly if a triangle of one surface shares a
/// point with a triangle of the other, else at most 1e-9 times the largest |coordinate| wide.
/// Leaves both trees fitted to the scaled vertices.
DistanceInterval surface_distance(ScaledSurface& a, ScaledSurface& b);

/// The interval from each point to the surface, in the order of `points`. The second of `triangles`
/// is the surface's. Points within the surface's largest coordinate share one fit of its tree.
std::vector<DistanceInterval> point_distances(std::span<const Vec3> points, ScaledSurface& surface);

}  // namespace contactcheck::oracle
