// What a report says of a scene of random pairs: how many, from which seed, and what rational
// arithmetic says of the oracle.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace contactcheck {

/// "10,000,000 pairs, seed 1, 5,012,345 touch; oracle against rational arithmetic: 0 wrong".
/// Empty for scenes without pairs.
std::string pairs_line(const nlohmann::ordered_json& scene);

/// Markdown: that line, and how many of each kind touch. Empty for scenes without pairs.
std::string pairs_markdown(const nlohmann::ordered_json& scene);

}  // namespace contactcheck
