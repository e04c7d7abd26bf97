// Contact response: impulses on velocities and geometric correction of positions, at the lattice
// nodes, through the embedding's weights.
// Source: Jeon, Hong, Choi, Jeong 2013, section on collision response (impulse plus geometric
// correction); Mirtich & Canny 1995 for impulses with Coulomb friction.
#pragma once

#include <span>
#include <vector>

#include "core/dynamics/contact_point.h"
#include "core/dynamics/deformable.h"
#include "core/dynamics/ground.h"
#include "core/dynamics/material.h"

namespace contactcheck {

/// A body as the response sees it. A body without material has no masses: it cannot be moved.
struct ResponseBody {
  NodeState* state = nullptr;
  std::span<const double> masses;  ///< per node; empty: the body cannot be moved
  double restitution = 0.0, friction = 0.0;
};

struct ResponseSettings {
  std::uint32_t iterations = 4;  ///< sweeps over all points, in order
  /// Share of the depth that a response corrects. It moves nodes, but not what they are tied to,
  /// and so strains springs: from about a third on this adds more energy than damping removes.
  double corrected_share = 0.1;
  /// m/s: slower approaches do not bounce. Above what gravity adds in one step of 1/60 s, or bodies
  /// at rest would hop.
  double least_bounce_speed = 0.4;
};

/// Sequential impulses over the points in their order, then position corrections. Linear momentum
/// of two movable bodies is conserved up to rounding.
void respond_to_contacts(const std::vector<ContactPoint>& points, const ResponseSettings& settings,
                         std::vector<ResponseBody>& bodies);

/// The same for vertices of one body that are on or below the ground's plane.
void respond_to_ground(const BodyShape& shape, const std::vector<std::uint32_t>& vertices,
                       const Ground& ground, const ResponseSettings& settings, ResponseBody& body);

}  // namespace contactcheck
