// The ground: a half-space that bodies fall onto. Outside all levels of contact and outside the
// time of a collision test; the same for every detector.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/deform/body.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// Solid where coordinate `axis` is at most `height`. Its predicate is one comparison of doubles,
/// hence exact; closed: a vertex on the plane touches.
struct Ground {
  int axis = 1;
  double height = 0.0;  ///< metres
  double restitution = 0.2, friction = 0.6;

  bool holds(const Vec3& point) const { return point[axis] <= height; }
};

/// The vertices of a body on or below the ground's plane, ascending. Maps only vertices of cells
/// with a node there (up to rounding, a mapped vertex lies within the hull of its cell's nodes).
std::vector<std::uint32_t> vertices_in_ground(const BodyShape& shape, std::span<const Vec3> nodes,
                                              const Ground& ground);

}  // namespace contactcheck
