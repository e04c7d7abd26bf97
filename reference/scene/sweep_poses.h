// From a scene with a sweep to its frames: poses of the second body, searched with the oracle.
#pragma once

#include <cstddef>
#include <functional>

#include "reference/scene/scene.h"

namespace contactcheck::scene {

/// Called before every orientation that is tried, with its number.
using OnPose = std::function<void(std::size_t)>;

/// Fills scene.recorded; nothing to do for scenes without a sweep.
///
/// The first body stays as it is. For every orientation the second one is turned by a random
/// rotation about the centre of its box, and comes along a random direction straight towards the
/// centre of the first one's box, from where a plane separates them. At a separation s > 0 it
/// stands where the certified distance of the two surfaces first is s; at 0 where they first touch;
/// and at s < 0 by |s| beyond that place, in the same direction (the depth is along the path:
/// surfaces that have slipped past each other need not touch). "First" and "is" within
/// kSweepTolerance of the scene's size. Orientations whose path misses the first body are drawn
/// again.
///
/// Frames are ordered by separation, then orientation. The same seed gives the same bits on every
/// machine.
/// @throws InputError, one sentence with the scene, when a pose cannot be found
void place_sweep(const OnPose& on_pose, Scene& scene);

}  // namespace contactcheck::scene
