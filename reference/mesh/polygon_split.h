// Triangles out of a polygon, whatever its outline, decided by exact signs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/types/mesh.h"

namespace contactcheck::mesh {

/// Looking for ears takes up to the cube of the corners.
inline constexpr std::size_t kMostConcaveCorners = 512;

struct SplitPolygon {
  std::vector<Triangle> triangles;  ///< two fewer than corners, turned as the polygon
  bool concave = false;             ///< the fan round the first corner leaves the polygon
};

/// Splits the polygon as it looks along the largest axis of its (Newell) normal. The fan round the
/// first corner where no two of its triangles are turned against each other (and, up to
/// kMostConcaveCorners, no two edges cross), ears cut off one by
/// one elsewhere. Nothing when the polygon crosses itself, or folds back on itself so that no ears
/// are left, or is concave with more than kMostConcaveCorners corners.
/// @pre at least three corners, indices of finite points
std::optional<SplitPolygon> split_polygon(const std::vector<Vec3>& points,
                                          std::span<const std::uint32_t> corners);

}  // namespace contactcheck::mesh
