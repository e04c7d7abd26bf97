#include "reference/mesh/subdivide.h"

#include <algorithm>
#include <map>
#include <utility>

namespace contactcheck::mesh {
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
