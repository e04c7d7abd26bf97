// The shortest way from a vertex to a surface.
#pragma once

#include "reference/oracle/surface_geometry.h"
#include "reference/oracle/surface_tree.h"

namespace contactcheck::oracle {

/// Depth: the distance from the vertex to the surface, off by less than 1e-12 of `size` or of the
/// depth. Directions: to the nearest point of every triangle that is as near within 1e-9 of `size`,
/// one for those that agree; none when the vertex lies on the surface (exactly).
/// @pre the tree is fitted; all |coordinates| <= 1
WayOut way_to_surface(const Vec3& vertex, const SurfaceTree& surface, double size);

}  // namespace contactcheck::oracle
