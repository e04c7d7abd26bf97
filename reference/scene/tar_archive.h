// One file out of a .tar.gz archive (POSIX ustar, zlib), in memory, without unpacking the rest.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace contactcheck {

/// The bytes of the regular file `member`, or nothing when the archive has none of that name.
/// @throws InputError when the archive cannot be read, is damaged or ends early
std::optional<std::string> read_tar_member(const std::filesystem::path& archive,
                                           const std::string& member);

}  // namespace contactcheck
