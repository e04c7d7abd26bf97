// What the results say about the paper's claims and this project's own goals, scene by scene.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace contactcheck {

/// Markdown: the hover gaps of ffd-grid and ffd-aabb side by side (the paper's claim: the first is
/// larger) and the speed of sphere2 against FCL in the questions both answer, with both sides'
/// errors beside it. Empty where the results lack these detectors.
std::string claims_markdown(const nlohmann::ordered_json& results);

}  // namespace contactcheck
