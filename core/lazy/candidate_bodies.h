// Which bodies can meet: pairs of boxes that overlap, by sweep and prune along one axis.
// Source: Cohen, Lin, Manocha, Ponamgi: I-COLLIDE, 1995 (here sorted anew, without coherence).
#pragma once

#include <span>
#include <vector>

#include "core/types/contact_set.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// Pairs of closed boxes that share a point, ascending.
void find_candidate_bodies(std::span<const Aabb> boxes, std::vector<BodyPair>& out);

}  // namespace contactcheck
