// What a surface says of vertices: which lie strictly inside it, which are closer than a margin.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/types/contact_set.h"
#include "core/types/vec3.h"
#include "reference/oracle/surface_tree.h"

namespace contactcheck::oracle {

/// The winding number of the surface around the point: how often it wraps it, outward-oriented
/// wraps counted positive; none when the point lies on the surface. Exact.
/// The surface may intersect itself, have any number of triangles on an edge and degenerate ones.
/// @pre the surface is a closed chain (closed_chain.h); the tree is refitted
std::optional<int> winding_number(const SurfaceTree& surface, const Vec3& point);

/// Not on the surface, and its winding number is not 0.
bool strictly_inside(const SurfaceTree& surface, const Vec3& point);

/// False only if no point of one box is within `margin` of the other: no pair is lost to rounding.
bool boxes_within(double margin, const Aabb& a, const Aabb& b);

/// Appends every pair of a vertex of `pair.a` and a triangle of `pair.b` at a distance strictly
/// below `margin`; exact, in any order, each once. With itself a body has all its triangles.
/// @pre margin finite; the tree is fitted to the vertices of `pair.b`
void append_near_pairs(BodyPair pair, std::span<const Vec3> vertices, const SurfaceTree& surface,
                       double margin, std::vector<NearPair>& out);

}  // namespace contactcheck::oracle
