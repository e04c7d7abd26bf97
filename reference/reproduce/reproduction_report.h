// The reproduction for people: Markdown, and a short table for a terminal.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace contactcheck {

/// @pre reproduction as reproduce() makes it
std::string reproduction_markdown(const nlohmann::ordered_json& reproduction);
/// One line per scene and reading; plain text.
std::string reproduction_terminal(const nlohmann::ordered_json& reproduction);

}  // namespace contactcheck
