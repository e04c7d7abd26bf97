#include "core/broad/adjacent_pairs.h"

#include <algorithm>

#include "core/types/mesh_topology.h"

namespace contactcheck {

std::vector<AdjacentPair> adjacent_pairs(std::span<const Triangle> triangles) {
  refuse_many_adjacent_pairs(triangles);
  // The triangles of each vertex, ascending.
  std::uint32_t vertices = 0;
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) vertices = std::max(vertices, v + 1);
  std::vector<std::uint32_t> begin(vertices + 1, 0), users(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) ++begin[v + 1];
  for (std::size_t v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
  std::vector<std::uint32_t> at(begin.begin(), begin.end() - 1);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t v : triangles[t]) users[at[v]++] = t;

  std::vector<AdjacentPair> out;
  std::vector<std::uint32_t> others;
  for (std::uint32_t a = 0; a < triangles.size(); ++a) {
    others.clear();
    for (const std::uint32_t v : triangles[a])
      for (std::uint32_t i = begin[v]; i < begin[v + 1]; ++i)
        if (users[i] > a) others.push_back(users[i]);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    for (const std::uint32_t b : others) {
      const SharedCorners shared = shared_corners(triangles[a], triangles[b]);
      if (!shared.duplicates) out.push_back({a, b, shared});
    }
  }
  return out;
}

}  // namespace contactcheck
