// How far apart the bodies of a scene are, frame by frame.
#pragma once

#include <vector>

#include "reference/judge/judged_scene.h"
#include "reference/process/shared_progress.h"

namespace contactcheck::judge {

/// The smallest distance between the surfaces of any two bodies in each frame, metres: the upper
/// end of the oracle's certified interval; 0 exactly in contact frames, which cost nothing here.
/// Empty with fewer than two bodies, and of families and random pairs, whose gaps are their own.
/// @pre the scene was not refused
std::vector<double> separations(const JudgedScene& judged, process::ProgressWriter& progress);

}  // namespace contactcheck::judge
