// Single precision about a local origin: a float holds about seven digits, and far from the origin
// of the world they are used up by the place where things are. So a detector in single precision
// subtracts one origin per frame, in double, and rounds once.
#pragma once

#include <span>

#include "core/types/frame.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// The largest |coordinate|, metres from the local origin, that single precision is used for: all
/// determinants, products of three differences, then stay finite (core/lazy/triangles-inl.h).
inline constexpr float kSingleLimit = 0x1p40f;

/// The centre of the box round BodyState::nodes of all bodies: lattice nodes, or the vertices of a
/// body without a lattice. Zero without bodies. The same for every order of bodies and nodes, never
/// overflows, and no node's distance from it does.
/// @pre all nodes finite
Vec3 local_origin(const Frame& frame);

/// A coordinate about an origin's coordinate: subtracted in double, then rounded once.
/// (g++ 12 at -O2 may skip the rounding to float where the result is converted back to double at
/// once: store it as a float or in a volatile.)
inline float local_value(double x, double origin) { return static_cast<float>(x - origin); }

/// local_value() of every coordinate of `points`. @pre as many places in `out` as points
/// @throws RefusedInput when one is farther than kSingleLimit from the origin, or no number
void round_to_local(std::span<const Vec3> points, const Vec3& origin, std::span<Vec3f> out);

}  // namespace contactcheck
