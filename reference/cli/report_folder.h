// The folder that a report is written into.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace contactcheck {

/// What `report` makes when it is not told, of "csv", "html" and "md".
std::vector<std::string> all_report_formats();

/// @throws InputError for a format that is none
void check_report_formats(const std::vector<std::string>& formats);

/// Texts by path below the report's folder; pictures (plots/*.svg) come with "md". "html" gives
/// nothing in a build without npm; its 3D view shows the recordings in `folder`, where results.json
/// stands. @pre check_report_formats passed
std::map<std::string, std::string> report_texts(const nlohmann::ordered_json& results,
                                                const std::filesystem::path& folder,
                                                const std::vector<std::string>& formats);

/// Results with what `reproduce` has made of them ("reproduction"), for the HTML report, where the
/// reproduction.json beside them is of the same run. @throws InputError when that is no JSON
nlohmann::ordered_json with_reproduction(nlohmann::ordered_json results,
                                         const std::filesystem::path& folder);

/// Where the reports among `files` are, one behind the other; also what was left out, and why.
std::string report_paths(const std::filesystem::path& folder,
                         const std::map<std::string, std::string>& files);

/// Writes files, by path below `folder`, each under a temporary name first. Pictures of an earlier
/// report (plots/*.svg) go. @throws InputError when a file cannot be written
void write_report(const std::filesystem::path& folder,
                  const std::map<std::string, std::string>& files);

}  // namespace contactcheck
