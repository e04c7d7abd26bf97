// Whether a point lies strictly inside a closed surface: exact non-zero winding.
#pragma once

#include <optional>

#include "core/types/vec3.h"
#include "reference/oracle/surface_tree.h"

namespace contactcheck::oracle {

/// The winding number of the surface around the point: how often it wraps it, outward-oriented
/// wraps counted positive; none when the point lies on the surface. Exact.
/// The surface may intersect itself and have degenerate triangles.
/// @pre the surface is edge-manifold, closed and consistently oriented; the tree is refitted
std::optional<int> winding_number(const SurfaceTree& surface, const Vec3& point);

/// Not on the surface, and its winding number is not 0.
bool strictly_inside(const SurfaceTree& surface, const Vec3& point);

}  // namespace contactcheck::oracle
