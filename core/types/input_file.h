// Opens input files that a user names: regular files, and links to such.
//
// A pipe without a writer would block for ever, and a device may have no end.
// Scenes, recordings and results are also read more than once, and by several processes.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace contactcheck {

/// Why `file` cannot be read, worded to follow its name: " does not exist", " is a pipe, not a
/// regular file". Empty for a regular file and a link to one. Does not open the file.
std::string input_file_fault(const std::filesystem::path& file);

/// Opens `file` for reading bytes. `name` is its name in messages: "mesh file \"x.off\"".
/// @throws InputError, one sentence, when it has a fault or cannot be opened
std::ifstream open_input_file(const std::filesystem::path& file, const std::string& name);

}  // namespace contactcheck
