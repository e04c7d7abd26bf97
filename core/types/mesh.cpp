#include "core/types/mesh.h"

#include <algorithm>

#include "core/types/given_vertices.h"
#include "core/types/hash.h"

namespace contactcheck {

Aabb bounding_box(const std::vector<Vec3>& points) {
  Aabb box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

Aabb bounding_box(const TriangleMesh& mesh) {
  Aabb box;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) box.extend(mesh.vertices[v]);
  return box;
}

GivenVertices drop_unused_vertices(TriangleMesh& mesh) {
  GivenVertices out;
  const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
  std::vector<std::uint32_t> index(count, 0);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) index[v] = 1;
  if (std::find(index.begin(), index.end(), 0u) == index.end()) return out;
  for (std::uint32_t v = 0; v < count; ++v) {
    if (index[v] == 0) continue;
    index[v] = static_cast<std::uint32_t>(out.numbers.size());
    mesh.vertices[out.numbers.size()] = mesh.vertices[v];
    out.numbers.push_back(v);
  }
  out.dropped = count - out.numbers.size();
  mesh.vertices.resize(out.numbers.size());
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = index[v];
  return out;
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
