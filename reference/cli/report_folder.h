// The folder that a report is written into.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reference/report/tables/paper_part.h"
#include "reference/results/results.h"

namespace contactcheck::cli {

/// The formats that `report` makes by default, of "csv", "html" and "md".
std::vector<std::string> all_report_formats();

/// @throws InputError for an unknown format
void check_report_formats(const std::vector<std::string>& formats);

/// Texts by path below the report's folder; pictures (plots/*.svg) come with "md". "html" gives
/// nothing in a build without npm; its 3D view shows the recordings in `folder`, where results.json
/// stands, and `paper`. @pre check_report_formats passed
std::map<std::string, std::string> report_texts(
    const results::Results& results, const std::filesystem::path& folder,
    const std::vector<std::string>& formats,
    const std::optional<report::PaperPart>& paper = std::nullopt);

/// The page's part from reproduction.json next to results.json, if that is of the same run.
/// @throws InputError when it cannot be read, or was written by another version
std::optional<report::PaperPart> paper_part_in(const std::filesystem::path& folder,
                                               const results::Results& results);

/// The paths of the reports among `files`, joined; also what was left out, and why.
std::string report_paths(const std::filesystem::path& folder,
                         const std::map<std::string, std::string>& files);

/// Writes files, by path below `folder`, each under a temporary name first. Removes pictures of an
/// earlier report (plots/*.svg). @throws InputError if a file cannot be written
void write_report(const std::filesystem::path& folder,
                  const std::map<std::string, std::string>& files);

}  // namespace contactcheck::cli
