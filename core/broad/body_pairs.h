// Which bodies can meet: sweep and prune over their boxes.
// Source: Cohen, Lin, Manocha, Ponamgi: I-COLLIDE, 1995 (here sorted anew in every frame, without
// coherence).
#pragma once

#include <span>
#include <vector>

#include "core/types/contact_set.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// Pairs of closed boxes that share a point, ascending: sweep and prune along one axis.
void find_candidate_bodies(std::span<const Aabb> boxes, std::vector<BodyPair>& out);

}  // namespace contactcheck
