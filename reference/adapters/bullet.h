// What the adapters of Bullet share: the library's version, and the world scale at which it sees a
// scene's triangles.
//
// Bullet 3.24 in single precision holds absolute limits in world units: a triangle whose
// |cross product of two edges|^2 is not above SIMD_EPSILON is no triangle to its projections
// (LinearMath/btScalar.h, November 2026). A mesh of unit size is full of those.
#pragma once

#include <string>
#include <vector>

#include "core/deform/body.h"

namespace contactcheck::adapters {

/// A box of coordinates as floats is wider than that of the doubles by at most this part of the
/// largest coordinate; a few roundings of its own included.
inline constexpr double kRoundingOfFedBoxes = 0x1p-21;

/// As Bullet's headers say, with the precision it is built in, e.g. "3.24 float".
std::string bullet_version();

/// Twice the area of the smallest rest triangle of a mesh that is no sliver: that has at least
/// 1e-6 of the median area of its own mesh's triangles. Triangles without area (as doubles compute
/// it) are left out. Square metres; infinity for a mesh without any other.
double smallest_doubled_area(const TriangleMesh& mesh);

/// World units per metre: the smallest power of two, at least 1 and at most 2^20, at which the
/// smallest rest triangle of every body (except slivers) has |cross|^2 >= 64 * SIMD_EPSILON, so
/// that it may shrink to an eighth of its area while it deforms. A power of two adds no rounding to
/// the coordinates. Reaching 2^20 leaves triangles that Bullet cannot see.
double automatic_bullet_scale(const std::vector<Body>& bodies);

}  // namespace contactcheck::adapters
