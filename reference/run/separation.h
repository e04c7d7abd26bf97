// How far apart the bodies of a scene are, frame by frame.
#pragma once

#include <vector>

#include "reference/run/judged_scene.h"

namespace contactcheck {

/// The smallest distance between the surfaces of any two bodies in each frame, metres: the upper
/// end of the oracle's certified interval; 0 exactly in contact frames, which cost nothing here.
/// Empty with fewer than two bodies, and of families and random pairs, whose gaps are their own.
/// @pre the scene was not refused
std::vector<double> separations(const JudgedScene& judged, ProgressWriter& progress);

}  // namespace contactcheck
