#include "core/types/mesh_edges.h"

#include <algorithm>

namespace contactcheck {

MeshEdges mesh_edges(std::span<const Triangle> triangles) {
  const auto side_of = [](const Triangle& t, std::size_t i) -> Edge {
    return {std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])};
  };
  MeshEdges out;
  out.edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (const Edge side = side_of(t, i); side[0] != side[1]) out.edges.push_back(side);
  std::sort(out.edges.begin(), out.edges.end());
  out.edges.erase(std::unique(out.edges.begin(), out.edges.end()), out.edges.end());
  out.edges.shrink_to_fit();
  out.of_triangle.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    std::array<std::uint32_t, 3>& numbers = out.of_triangle.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge side = side_of(t, i);
      const auto place = std::lower_bound(out.edges.begin(), out.edges.end(), side);
      numbers[i] = side[0] == side[1] ? MeshEdges::kNone
                                      : static_cast<std::uint32_t>(place - out.edges.begin());
    }
  }
  return out;
}

}  // namespace contactcheck
