#pragma once

#include "core/narrow/triangle_triangle.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// True when the closed triangle (segment or point where degenerate) and the closed box share a
/// point. Exact for all finite doubles. Used to label triangles with lattice cells at rest.
bool triangle_meets_box(const TrianglePoints& triangle, const Aabb& box);

}  // namespace contactcheck
