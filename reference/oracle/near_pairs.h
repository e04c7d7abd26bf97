// The truth of the level `near`: vertices closer to a surface than a margin.
#pragma once

#include <span>
#include <vector>

#include "core/types/contact_set.h"
#include "core/types/vec3.h"
#include "reference/oracle/surface_tree.h"

namespace contactcheck::oracle {

/// False only if no point of one box is within `margin` of the other: no pair is lost to rounding.
bool boxes_within(double margin, const Aabb& a, const Aabb& b);

/// Appends every pair of a vertex of `pair.a` and a triangle of `pair.b` at a distance strictly
/// below `margin`; exact, in any order, each once.
/// @pre margin finite; the tree is fitted to the vertices of `pair.b`
void append_near_pairs(BodyPair pair, std::span<const Vec3> vertices, const SurfaceTree& surface,
                       double margin, std::vector<NearPair>& out);

}  // namespace contactcheck::oracle
