// What the results say about the paper's claims and this project's own goals, scene by scene.
#pragma once

#include <string>

#include "reference/results/results.h"

namespace contactcheck {

/// Markdown: the hover gaps of ffd-grid and ffd-aabb side by side (the paper's claim: the first is
/// larger) and the speed of sphere2 against FCL in the questions both answer, with both sides'
/// errors beside it. Empty where the results lack these detectors.
std::string claims_markdown(const results::Results& results);

}  // namespace contactcheck
