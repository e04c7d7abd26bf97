// The chart of speed against error in the Markdown report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace contactcheck {

/// The chart, what it shows, and its points as a table. Empty where nothing was timed.
std::string speed_error_markdown(const nlohmann::ordered_json& results);

/// The picture that the section shows, empty where it shows none.
std::string speed_error_picture(const nlohmann::ordered_json& results);

}  // namespace contactcheck
