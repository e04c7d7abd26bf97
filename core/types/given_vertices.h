// A vertex that no triangle uses is no part of a body. It is dropped where a mesh comes in, and
// what people give and see still numbers the vertices as the mesh did.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/types/mesh.h"

namespace contactcheck {

/// Which vertices of a mesh as it was given a body has. A number is the index of a vertex there.
struct GivenVertices {
  /// The number of each vertex of the body, ascending; empty where none was dropped.
  std::vector<std::uint32_t> numbers;
  std::size_t dropped = 0;

  std::uint32_t number_of(std::uint32_t vertex) const {
    return numbers.empty() ? vertex : numbers[vertex];
  }
  /// The body's vertex of that number; none where it was dropped. @pre the number was given
  std::optional<std::uint32_t> vertex_of(std::uint32_t number) const {
    if (numbers.empty()) return number;
    const auto found = std::lower_bound(numbers.begin(), numbers.end(), number);
    if (found == numbers.end() || *found != number) return std::nullopt;
    return static_cast<std::uint32_t>(found - numbers.begin());
  }
  /// Of one value per given vertex, those of the body's.
  template <typename T>
  std::vector<T> kept(std::vector<T> given) const {
    if (numbers.empty()) return given;
    std::vector<T> out;
    out.reserve(numbers.size());
    for (const std::uint32_t number : numbers) out.push_back(given[number]);
    return out;
  }
  /// Of one value per vertex of the body, one per given vertex: a dropped one has the value of the
  /// nearest kept one before it, or else of the first. No box grows by it.
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
  /// The body's triangles, by numbers.
  std::vector<Triangle> numbered(std::vector<Triangle> triangles) const {
    for (Triangle& triangle : triangles)
      for (std::uint32_t& vertex : triangle) vertex = number_of(vertex);
    return triangles;
  }
};

/// Drops what no triangle uses; the order of the rest is kept. @pre indices are in range
GivenVertices drop_unused_vertices(TriangleMesh& mesh);

}  // namespace contactcheck
