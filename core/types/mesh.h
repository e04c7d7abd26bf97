#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck {

using Triangle = std::array<std::uint32_t, 3>;

/// An indexed triangle mesh. Vertices in metres; triangles counter-clockwise seen from outside
/// where the surface is closed.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

Aabb bounding_box(const std::vector<Vec3>& points);
/// Bounds the vertices that triangles use; a body has no others. @pre indices are in range
Aabb bounding_box(const TriangleMesh& mesh);

/// 64-bit FNV-1a over the bits of vertices and indices: the same mesh, the same hash, everywhere.
std::uint64_t content_hash(const TriangleMesh& mesh);

}  // namespace contactcheck
