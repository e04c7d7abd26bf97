// Splits polygons of any outline into triangles, decided by exact signs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/types/mesh.h"

namespace contactcheck::mesh {

/// Finding ears takes up to the cube of the number of corners.
inline constexpr std::size_t kMostConcaveCorners = 512;

struct SplitPolygon {
  std::vector<Triangle> triangles;  ///< two fewer than corners, oriented as the polygon
  bool concave = false;             ///< the fan round the first corner is not inside the polygon
};

/// Splits the polygon as seen along the largest axis of its (Newell) normal: by the fan round the
/// first corner if no two of its triangles have opposite orientation (and, up to
/// kMostConcaveCorners, no two edges cross), else by cutting off ears. Nothing if the polygon
/// crosses itself, folds back on itself so that no ears are left, or is concave with more than
/// kMostConcaveCorners corners.
/// @pre at least three corners, indices of finite points
std::optional<SplitPolygon> split_polygon(const std::vector<Vec3>& points,
                                          std::span<const std::uint32_t> corners);

}  // namespace contactcheck::mesh
