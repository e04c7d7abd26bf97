// Makes the frames of a scene with a sweep: poses of the second body, searched with the oracle.
#pragma once

#include <cstddef>
#include <functional>

#include "reference/scene/scene.h"

namespace contactcheck::scene {

/// Called before every orientation that is tried, with its number.
using OnPose = std::function<void(std::size_t)>;

/// Fills scene.recorded; does nothing for scenes without a sweep.
///
/// The first body stays in place. For every orientation the second one is rotated at random about
/// the centre of its box. From where a plane separates the bodies, it moves along a random
/// direction straight towards the centre of the first body's box. At a separation s > 0 it stops
/// where the certified distance of the surfaces first is s; at 0 where they first touch; at s < 0
/// it is |s| beyond that point along the path (surfaces that have slipped past each other need not
/// touch). All within kSweepTolerance of the scene's size. Orientations whose path misses the first
/// body are drawn again.
///
/// Frames are ordered by separation, then orientation. The same seed gives the same bits on every
/// machine.
/// @throws InputError, one sentence with the scene, when a pose cannot be found
void place_sweep(const OnPose& on_pose, Scene& scene);

}  // namespace contactcheck::scene
