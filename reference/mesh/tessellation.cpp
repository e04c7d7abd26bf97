#include "reference/mesh/tessellation.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/types/given_vertices.h"
#include "core/types/mesh_topology.h"
#include "core/types/vertex_places.h"

namespace contactcheck::mesh {
namespace {

// Edge collapses by meshoptimizer, straight to the count of triangles.
TriangleMesh collapsed(const TriangleMesh& mesh, std::size_t triangles) {
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  // Relative to the box: far from the origin floats would lose the shape.
  const Aabb box = bounding_box(mesh);
  const double size = box.extent().maxCoeff();
  const double scale = size > 0.0 ? 1.0 / size : 1.0;
  std::vector<float> floats;
  floats.reserve(3 * mesh.vertices.size());
  for (const Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) floats.push_back(static_cast<float>((v[k] - box.lo[k]) * scale));
  std::vector<std::uint32_t> kept(indices.size());
  // The count decides alone: no limit on the error.
  kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), floats.data(),
                               mesh.vertices.size(), 3 * sizeof(float), 3 * triangles,
                               std::numeric_limits<float>::max()));

  TriangleMesh out;
  out.vertices = mesh.vertices;
  for (std::size_t i = 0; i + 2 < kept.size(); i += 3)
    out.triangles.push_back({kept[i], kept[i + 1], kept[i + 2]});
  drop_unused_vertices(out);
  return out;
}

}  // namespace

namespace {

// Vertices at one place are one; without the triangles that are a segment or a point by that.
TriangleMesh without_copies(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> first = first_at_place(mesh.vertices);
  TriangleMesh out;
  out.vertices = mesh.vertices;
  for (const Triangle& t : mesh.triangles) {
    const Triangle joined = {first[t[0]], first[t[1]], first[t[2]]};
    if (joined[0] != joined[1] && joined[1] != joined[2] && joined[2] != joined[0])
      out.triangles.push_back(joined);
  }
  drop_unused_vertices(out);
  return out;
}

TriangleMesh simplified_as_given(const TriangleMesh& mesh, std::size_t triangles) {
  if (mesh.triangles.size() <= triangles) return mesh;
  TriangleMesh direct = collapsed(mesh, triangles);
  if (analyse_topology(direct).solid || !analyse_topology(mesh).solid) return direct;
  // Multiples of the wanted count to go over, likeliest first.
  for (const double factor : {1.5, 1.25, 2.0, 3.0}) {
    const auto between = static_cast<std::size_t>(factor * static_cast<double>(triangles));
    if (between >= mesh.triangles.size()) continue;
    TriangleMesh detour = collapsed(collapsed(mesh, between), triangles);
    if (detour.triangles.size() == direct.triangles.size() && analyse_topology(detour).solid)
      return detour;
  }
  return direct;
}

}  // namespace

TriangleMesh simplify(const TriangleMesh& mesh, std::size_t triangles) {
  TriangleMesh direct = simplified_as_given(mesh, triangles);
  if (direct.triangles.size() <= triangles) return direct;
  const TriangleMesh whole = without_copies(mesh);
  if (whole.vertices.size() == mesh.vertices.size()) return direct;
  TriangleMesh joined = simplified_as_given(whole, triangles);
  const bool better =
      !joined.triangles.empty() && joined.triangles.size() < direct.triangles.size();
  return better ? joined : direct;
}

TriangleMesh subdivide(TriangleMesh mesh, std::size_t times) {
  for (; times > 0; --times) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> midpoints;
    const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
      const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
      const auto [known, added] = midpoints.try_emplace(std::minmax(a, b), next);
      if (added) {
        const Vec3 middle = 0.5 * mesh.vertices[a] + 0.5 * mesh.vertices[b];  // no overflow
        mesh.vertices.push_back(middle);
      }
      return known->second;
    };
    std::vector<Triangle> finer;
    finer.reserve(4 * mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

}  // namespace contactcheck::mesh
