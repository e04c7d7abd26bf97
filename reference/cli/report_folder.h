// The folder that a report is written into.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace contactcheck {

/// Writes files, by path below `folder`, each under a temporary name first. Pictures of an earlier
/// report (plots/*.svg) go. @throws InputError when a file cannot be written
void write_report(const std::filesystem::path& folder,
                  const std::map<std::string, std::string>& files);

}  // namespace contactcheck
