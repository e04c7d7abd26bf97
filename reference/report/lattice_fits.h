// What a report says of lattices that were fitted to recordings: how far the scene is from them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace contactcheck {

/// Markdown: per body the error over all frames and the worst frame. Empty for scenes without a
/// fitted lattice.
std::string fits_markdown(const nlohmann::ordered_json& scene);

}  // namespace contactcheck
