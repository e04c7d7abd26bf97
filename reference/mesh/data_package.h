// Where the data of Debian packages lies.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace contactcheck::mesh {

/// The folders that stand for "/" when a package's file is looked for, in order: $CONTACTCHECK_DATA
/// alone when it is set; else "/" and ${XDG_CACHE_HOME:-~/.cache}/contactcheck, where .ci/setup
/// unpacks the packages on images that leave /usr/share/doc out.
std::vector<std::filesystem::path> data_roots();

/// The first root / `path` that is a file. `path` is relative to "/" ("usr/share/doc/...").
/// @throws InputError, one sentence that names the Debian package and how to install it
std::filesystem::path find_package_file(const std::vector<std::filesystem::path>& roots,
                                        const std::string& package, const std::string& path);

}  // namespace contactcheck::mesh
