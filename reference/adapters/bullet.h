// Common parts of the Bullet adapters: the library's version, and the world scale at which Bullet
// sees a scene's triangles.
//
// Bullet 3.24 in single precision has absolute limits in world units: a triangle whose |cross
// product of two edges|^2 is not above SIMD_EPSILON is ignored by its projections
// (LinearMath/btScalar.h, November 2026). A mesh of unit size has many of those.
#pragma once

#include <string>
#include <vector>

#include "core/deform/body.h"

namespace contactcheck::adapters {

/// Single-precision boxes exceed double-precision ones by at most this share of the largest
/// coordinate, a few roundings of Bullet's included.
inline constexpr double kRoundingOfFedBoxes = 0x1p-21;

/// From Bullet's headers, with its precision, e.g. "3.24 float".
std::string bullet_version();

/// Twice the area, in square metres, of the smallest rest triangle that is not a sliver: it has at
/// least 1e-6 of the median area of its mesh. Triangles whose computed area is 0 are left out.
/// Infinity if no triangle remains.
double smallest_doubled_area(const TriangleMesh& mesh);

/// World units per metre: the smallest power of two, at least 1 and at most 2^20, at which the
/// smallest rest triangle of every body (except slivers) has |cross|^2 >= 64 * SIMD_EPSILON, so
/// that it may shrink to an eighth of its area while it deforms. A power of two adds no rounding to
/// the coordinates. Reaching 2^20 leaves triangles that Bullet cannot see.
double automatic_bullet_scale(const std::vector<Body>& bodies);

}  // namespace contactcheck::adapters
