// What results.json says about a scene itself.
#pragma once

#include <vector>

#include "reference/judge/judged_scene.h"
#include "reference/results/results.h"

namespace contactcheck::judge {

/// Bodies, frames, the ground truth at every level that the scene asks for, and the
/// contact_hash of a detector that finds exactly the true pairs of triangles; `separations` per
/// frame, where there are any (judged_scene.h).
results::Scene scene_summary(const JudgedScene& judged,
                             const std::vector<double>& separations = {});

}  // namespace contactcheck::judge
