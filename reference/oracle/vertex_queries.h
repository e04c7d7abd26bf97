// Queries of vertices against a surface: strictly inside it, or nearer than a margin.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/types/contact_set.h"
#include "core/types/vec3.h"
#include "reference/oracle/surface_tree.h"

namespace contactcheck::oracle {

/// The winding number of the surface around the point, outward-oriented wraps counted positive;
/// none if the point lies on the surface. Exact. The surface may intersect itself, have degenerate
/// triangles and any number of triangles on an edge.
/// @pre the surface is a closed chain (closed_chain.h); the tree is refitted
std::optional<int> winding_number(const SurfaceTree& surface, const Vec3& point);

/// True if the point is not on the surface and its winding number is not 0.
bool strictly_inside(const SurfaceTree& surface, const Vec3& point);

/// False only if no point of one box is within `margin` of the other; rounding loses no pair.
bool boxes_within(double margin, const Aabb& a, const Aabb& b);

/// Appends every pair of a vertex of `pair.a` and a triangle of `pair.b` with a distance strictly
/// below `margin`: exact, in any order, each once. For a body with itself, all its triangles count.
/// @pre margin finite; the tree is fitted to the vertices of `pair.b`
void append_near_pairs(BodyPair pair, std::span<const Vec3> vertices, const SurfaceTree& surface,
                       double margin, std::vector<NearPair>& out);

}  // namespace contactcheck::oracle
