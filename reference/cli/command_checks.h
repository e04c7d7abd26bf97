// What commands that write a folder check alike, before they write a byte.
#pragma once

#include <filesystem>

namespace contactcheck::cli {

/// Creates --out where it is missing. @throws InputError when it cannot be written
void check_out(const std::filesystem::path& out);

}  // namespace contactcheck::cli
