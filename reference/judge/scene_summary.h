// The entry of a scene in results.json.
#pragma once

#include <vector>

#include "reference/judge/judged_scene.h"
#include "reference/results/results.h"

namespace contactcheck::judge {

/// Bodies, frames, the ground truth at every level that the scene wants, and the contact_hash of a
/// detector that finds exactly the true pairs of triangles. `separations`: per frame, metres, or
/// empty (judged_scene.h).
results::Scene scene_summary(const JudgedScene& judged,
                             const std::vector<double>& separations = {});

}  // namespace contactcheck::judge
