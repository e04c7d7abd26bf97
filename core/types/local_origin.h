// Single precision about a local origin. A float has about seven digits; far from the world origin
// they are spent on where the scene is. So a detector in single precision subtracts one origin per
// frame, in double, and rounds once.
#pragma once

#include <span>

#include "core/types/frame.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// The largest |coordinate|, metres from the local origin, that single precision is used for: all
/// determinants, products of three differences, then stay finite (core/lazy/triangles-inl.h).
inline constexpr float kSingleLimit = 0x1p40f;

/// The centre of the box round BodyState::nodes of all bodies: lattice nodes, or the vertices of a
/// body without a lattice. Zero without bodies. It does not depend on the order of bodies and
/// nodes. Neither it nor a node's coordinate about it overflows.
/// @pre all nodes finite
Vec3 local_origin(const Frame& frame);

/// A coordinate about an origin's coordinate: subtracted in double, then rounded once.
/// (g++ 12 at -O2 may skip the rounding to float where the result is converted back to double at
/// once: store it as a float or in a volatile.)
inline float local_value(double x, double origin) { return static_cast<float>(x - origin); }

/// Writes local_value() of every coordinate of `points` to `out`. @pre both have the same size
/// @throws RefusedInput when one is farther than kSingleLimit from the origin, or NaN
void round_to_local(std::span<const Vec3> points, const Vec3& origin, std::span<Vec3f> out);

}  // namespace contactcheck
