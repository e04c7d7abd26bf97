// One way out for two bodies. A point of contact names the way out of one box or triangle, which
// deep inside a body is any way: through a face between two cells, or along the surface. So the
// points of two bodies hear what all of them say together, and those that would push across it or
// against it push that way.
#pragma once

#include <map>
#include <vector>

#include "core/dynamics/contact_point.h"

namespace contactcheck {

/// Per pair of bodies a vector from a to b, of any length.
using Directions = std::map<BodyPair, Vec3>;

/// Gives every point whose normal is more than 60 degrees off its bodies' common direction that
/// direction instead. Points keep their depths and places. A direction of zero says nothing.
void agree_on_directions(const Directions& common, std::vector<ContactPoint>& points);

}  // namespace contactcheck
