// Writing a file so that it is either complete or not there.
#pragma once

#include <filesystem>
#include <string_view>

namespace contactcheck {

/// Writes `bytes` under a temporary name in the folder of `file`, flushes them to disk and renames.
/// A failure leaves neither the temporary file nor a changed `file`.
/// @throws InputError: path, what failed and the system's reason
void write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

}  // namespace contactcheck
