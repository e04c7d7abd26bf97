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

/// The vertices of a body that the ground holds, ascending. Maps only vertices of cells of which a
/// node reaches below the ground (a mapped vertex lies within its cell's nodes up to rounding,
/// which is allowed for).
std::vector<std::uint32_t> vertices_in_ground(const BodyShape& shape, std::span<const Vec3> nodes,
                                              const Ground& ground);

}  // namespace contactcheck
