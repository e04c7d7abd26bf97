// The job of GitHub Actions that the program runs in, if it does.
#pragma once

#include <filesystem>
#include <string>

namespace contactcheck::cli {

/// The path in GITHUB_STEP_SUMMARY; empty if it is not set.
std::filesystem::path github_summary_file();

/// Appends Markdown: GitHub gives every step a file of its own, to which all its commands append.
/// @throws InputError when the file cannot be written
void append_github_summary(const std::filesystem::path& file, const std::string& text);

}  // namespace contactcheck::cli
