#include "reference/mesh/tessellation.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/types/mesh_topology.h"

namespace contactcheck::mesh {
namespace {

// Relative to the box: far from the origin floats would lose the shape.
std::vector<float> as_floats(const TriangleMesh& mesh) {
  const Aabb box = bounding_box(mesh.vertices);
  const double size = box.extent().maxCoeff();
  const double scale = size > 0.0 ? 1.0 / size : 1.0;
  std::vector<float> out;
  out.reserve(3 * mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) {
    for (int k = 0; k < 3; ++k) out.push_back(static_cast<float>((v[k] - box.lo[k]) * scale));
  }
  return out;
}

TriangleMesh without_unused_vertices(const TriangleMesh& mesh,
                                     const std::vector<std::uint32_t>& indices) {
  constexpr std::uint32_t kUnused = UINT32_MAX;
  std::vector<std::uint32_t> number(mesh.vertices.size(), kUnused);
  for (const std::uint32_t i : indices) number[i] = 0;
  TriangleMesh out;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kUnused) continue;
    number[v] = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.push_back(mesh.vertices[v]);
  }
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    out.triangles.push_back({number[indices[i]], number[indices[i + 1]], number[indices[i + 2]]});
  }
  return out;
}

TriangleMesh collapsed(const TriangleMesh& mesh, std::size_t triangles) {
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  const std::vector<float> floats = as_floats(mesh);
  std::vector<std::uint32_t> kept(indices.size());
  // The count decides alone: no limit on the error.
  kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), floats.data(),
                               mesh.vertices.size(), 3 * sizeof(float), 3 * triangles,
                               std::numeric_limits<float>::max()));
  return without_unused_vertices(mesh, kept);
}

// Multiples of the wanted count to go over, likeliest first.
constexpr std::array kDetours = {1.5, 1.25, 2.0, 3.0};

TriangleMesh solid_detour(const TriangleMesh& mesh, std::size_t triangles, TriangleMesh direct) {
  for (const double factor : kDetours) {
    const auto between = static_cast<std::size_t>(factor * static_cast<double>(triangles));
    if (between >= mesh.triangles.size()) continue;
    TriangleMesh detour = collapsed(collapsed(mesh, between), triangles);
    if (detour.triangles.size() == direct.triangles.size() && analyse_topology(detour).solid) {
      return detour;
    }
  }
  return direct;
}

}  // namespace

TriangleMesh simplify(const TriangleMesh& mesh, std::size_t triangles) {
  if (mesh.triangles.size() <= triangles) return mesh;
  TriangleMesh direct = collapsed(mesh, triangles);
  if (analyse_topology(direct).solid || !analyse_topology(mesh).solid) return direct;
  return solid_detour(mesh, triangles, std::move(direct));
}

namespace {

class Midpoints {
 public:
  explicit Midpoints(std::vector<Vec3>& vertices) : vertices_(vertices) {}

  std::uint32_t of(std::uint32_t a, std::uint32_t b) {
    const auto next = static_cast<std::uint32_t>(vertices_.size());
    const auto [known, added] = known_.try_emplace(std::minmax(a, b), next);
    if (added) {
      const Vec3 middle = 0.5 * vertices_[a] + 0.5 * vertices_[b];  // no overflow
      vertices_.push_back(middle);
    }
    return known->second;
  }

 private:
  std::vector<Vec3>& vertices_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known_;
};

}  // namespace

TriangleMesh subdivide(TriangleMesh mesh, std::size_t times) {
  for (; times > 0; --times) {
    Midpoints midpoints(mesh.vertices);
    std::vector<Triangle> finer;
    finer.reserve(4 * mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = midpoints.of(a, b), bc = midpoints.of(b, c), ca = midpoints.of(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

}  // namespace contactcheck::mesh
