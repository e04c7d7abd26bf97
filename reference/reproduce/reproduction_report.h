// The reproduction for people: Markdown, a short table for a terminal, a part of the HTML page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reference/report/tables/paper_part.h"

namespace contactcheck::reproduce {

/// @pre reproduction as reproduce() makes it
std::string reproduction_markdown(const nlohmann::ordered_json& reproduction);
/// One line per scene and reading; plain text.
std::string reproduction_terminal(const nlohmann::ordered_json& reproduction);

/// The page's part, from the document of reproduce() with paper_json() as "paper".
/// @throws nlohmann::json::exception for another document or version
report::PaperPart paper_part(const nlohmann::ordered_json& reproduction);

}  // namespace contactcheck::reproduce
