// Vertices that no triangle uses are dropped when a mesh is loaded. Users still give and see the
// vertex indices of the mesh as it was given.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/types/mesh.h"

namespace contactcheck {

/// Maps a body's vertices to those of its mesh as given. A "number" is a vertex index of that mesh.
struct GivenVertices {
  /// Per vertex of the body its number, ascending; empty if no vertex was dropped.
  std::vector<std::uint32_t> numbers;
  std::size_t dropped = 0;

  std::uint32_t number_of(std::uint32_t vertex) const {
    return numbers.empty() ? vertex : numbers[vertex];
  }
  /// The body's vertex with this number; none if it was dropped. @pre the given mesh has the number
  std::optional<std::uint32_t> vertex_of(std::uint32_t number) const {
    if (numbers.empty()) return number;
    const auto found = std::lower_bound(numbers.begin(), numbers.end(), number);
    if (found == numbers.end() || *found != number) return std::nullopt;
    return static_cast<std::uint32_t>(found - numbers.begin());
  }
  /// Selects the values of the body's vertices. `given`: one value per vertex of the given mesh.
  template <typename T>
  std::vector<T> kept(std::vector<T> given) const {
    if (numbers.empty()) return given;
    std::vector<T> out;
    out.reserve(numbers.size());
    for (const std::uint32_t number : numbers) out.push_back(given[number]);
    return out;
  }
  /// Turns one value per vertex of the body into one per given vertex: a dropped vertex repeats the
  /// value of the kept one before it, or else of the first, so that no bounding box grows.
  template <typename T>
  std::vector<T> spread(const std::vector<T>& values) const {
    if (numbers.empty()) return values;
    std::vector<T> out;
    std::size_t at = 0;
    for (std::size_t number = 0; number < values.size() + dropped; ++number) {
      if (at + 1 < numbers.size() && numbers[at + 1] <= number) ++at;
      out.push_back(values[at]);
    }
    return out;
  }
  /// Replaces the body's vertex indices in `triangles` by their numbers.
  std::vector<Triangle> numbered(std::vector<Triangle> triangles) const {
    for (Triangle& triangle : triangles)
      for (std::uint32_t& vertex : triangle) vertex = number_of(vertex);
    return triangles;
  }
};

/// Drops the vertices that no triangle uses; keeps the others' order. @pre indices are in range
GivenVertices drop_unused_vertices(TriangleMesh& mesh);

}  // namespace contactcheck
