// Whole files as bytes, with one sentence for whatever keeps a file from being read.
#pragma once

#include <filesystem>
#include <string>

namespace contactcheck::text {

/// No document that people write or this suite reads comes near; meshes may.
inline constexpr std::size_t kLongestDocument = std::size_t{256} << 20,
                             kLongestMesh = std::size_t{4} << 30;  // bytes

/// The bytes of `file`. `kind` names it in messages: "scene file", "mesh file".
/// @throws InputError when it does not exist, is no regular file, cannot be read, is empty, or has
/// more than `longest` bytes
std::string read_file_bytes(const std::filesystem::path& file, const std::string& kind,
                            std::size_t longest = kLongestDocument);

/// `text` in double quotes, control characters replaced, shortened after `longest` bytes: fit for a
/// one-line message.
std::string in_quotes(const std::string& text, std::size_t longest = std::string::npos);

/// A sentence without its full stop, to be continued by another.
std::string without_full_stop(std::string sentence);

}  // namespace contactcheck::text
