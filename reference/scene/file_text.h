// Whole files as bytes, with one sentence for whatever keeps a file from being read.
#pragma once

#include <filesystem>
#include <string>

namespace contactcheck {

/// The bytes of `file`. `kind` names it in messages: "scene file", "mesh file".
/// @throws InputError when it does not exist, is a folder, cannot be read, or is empty
std::string read_file_bytes(const std::filesystem::path& file, const std::string& kind);

/// `text` in double quotes, control characters replaced, shortened after `longest` bytes: fit for a
/// one-line message.
std::string in_quotes(const std::string& text, std::size_t longest = std::string::npos);

/// A sentence without its full stop, to be continued by another.
std::string without_full_stop(std::string sentence);

}  // namespace contactcheck
