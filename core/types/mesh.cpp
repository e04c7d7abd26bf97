#include "core/types/mesh.h"

#include "core/types/hash.h"

namespace contactcheck {

Aabb bounding_box(const std::vector<Vec3>& points) {
  Aabb box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

std::uint64_t content_hash(const TriangleMesh& mesh) {
  Fnv1a hash;
  hash.value(static_cast<std::uint64_t>(mesh.vertices.size()));
  for (const Vec3& v : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) hash.value(v[axis]);
  hash.value(static_cast<std::uint64_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles)
    for (std::uint32_t index : t) hash.value(index);
  return hash.digest();
}

}  // namespace contactcheck
