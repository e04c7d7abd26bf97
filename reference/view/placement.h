// Where the view's unit box lies in the scene: single precision then serves scenes of every size
// and at every distance from the origin.
#pragma once

#include <span>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck {

/// A point p of the scene is (p - origin) / scale in the view, within [-1, 1].
struct Placement {
  Vec3 origin = Vec3::Zero();
  double scale = 1.0;  ///< a power of two, metres

  Vec3 in_view(const Vec3& p) const { return (p - origin) / scale; }
};

/// By frame, body, node.
using FrameNodes = std::vector<std::vector<std::vector<Vec3>>>;

/// One placement for all frames, so that the eye sees motion as it is; one per frame where a frame
/// would be too small to see, or its nodes too coarse, in the box of all.
std::vector<Placement> view_placements(const FrameNodes& frames);

}  // namespace contactcheck
