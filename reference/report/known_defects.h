// Wrong answers that libraries are known to give, beside those that a run shows.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace contactcheck {

/// Of the field `known_defects` of results.json: what is listed and shows, what is listed and does
/// not, what shows and is not listed. Empty where results have no such field.
std::string known_defects_markdown(const nlohmann::ordered_json& results);

/// The same field's value in plain lines, for a terminal: all of it, or only what differs.
std::string defects_text(const nlohmann::ordered_json& known_defects);
std::string defects_summary(const nlohmann::ordered_json& known_defects);

}  // namespace contactcheck
