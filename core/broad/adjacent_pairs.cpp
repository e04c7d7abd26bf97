#include "core/broad/adjacent_pairs.h"

#include <algorithm>
#include <string>

#include "core/types/check.h"

namespace contactcheck {

std::vector<AdjacentPair> adjacent_pairs(std::span<const Triangle> triangles) {
  // The triangles of each vertex, ascending.
  std::uint32_t vertices = 0;
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) vertices = std::max(vertices, v + 1);
  std::vector<std::uint32_t> begin(vertices + 1, 0), users(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) ++begin[v + 1];
  std::uint64_t most = 0;  // a pair that shares two vertices counts twice
  for (std::size_t v = 0; v < vertices; ++v) {
    const std::uint64_t valence = begin[v + 1];
    most += valence * (valence - 1) / 2;
    begin[v + 1] += begin[v];
  }
  if (most > kMostAdjacentPairs)
    throw RefusedInput("the detector refuses a mesh whose triangles share vertices in " +
                       std::to_string(most) + " pairs; at most " +
                       std::to_string(kMostAdjacentPairs) + " are enumerated");
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
