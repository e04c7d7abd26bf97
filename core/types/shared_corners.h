// What two triangles of one mesh have in common, by the vertices that they name.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/types/mesh.h"

namespace contactcheck {

/// The corners of two triangles, those at shared vertices first and in the same order.
struct SharedCorners {
  std::uint32_t count = 0;  ///< different vertices that both name
  bool duplicates = false;  ///< both name the same set of vertices
  /// Corner indices of each triangle, in that order.
  std::array<std::uint8_t, 3> p = {0, 1, 2}, q = {0, 1, 2};
};

/// For a welded mesh pass triangles of BodyShape::linked(). They may name a vertex twice; it counts
/// once.
inline SharedCorners shared_corners(const Triangle& p, const Triangle& q) {
  SharedCorners out;
  const auto has = [](const Triangle& t, std::uint32_t vertex) {
    return t[0] == vertex || t[1] == vertex || t[2] == vertex;
  };
  if (!has(q, p[0]) && !has(q, p[1]) && !has(q, p[2])) return out;
  const auto bring_forward = [&](std::array<std::uint8_t, 3>& corners, const Triangle& t,
                                 std::uint32_t vertex) {
    std::uint32_t at = out.count;
    while (t[corners[at]] != vertex) ++at;
    std::swap(corners[out.count], corners[at]);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const bool again = (i > 0 && p[i] == p[0]) || (i > 1 && p[i] == p[1]);
    if (again || !has(q, p[i])) continue;
    bring_forward(out.p, p, p[i]);
    bring_forward(out.q, q, p[i]);
    ++out.count;
  }
  out.duplicates =
      has(q, p[0]) && has(q, p[1]) && has(q, p[2]) && has(p, q[0]) && has(p, q[1]) && has(p, q[2]);
  return out;
}

}  // namespace contactcheck
