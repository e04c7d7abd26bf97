// The Markdown report with its pictures.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace contactcheck {

/// Texts by path below the report's folder: report.md and plots/*.svg.
/// @throws nlohmann::json::exception when results are not as the schema says
std::map<std::string, std::string> report_files(const nlohmann::ordered_json& results);

}  // namespace contactcheck
