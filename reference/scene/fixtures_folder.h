// Where the data that comes with contactcheck lies: scenes/, suites/, hard/, paper/, policies/.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace contactcheck::scene {

/// $CONTACTCHECK_FIXTURES where it is set; else the first that is a folder of: the data installed
/// with the running program, the source tree this was built from, and contactcheck/fixtures in
/// $XDG_DATA_DIRS (default /usr/local/share and /usr/share), for programs of others that link the
/// library. None is: that of the source tree, for the sentence that says what is missing.
std::filesystem::path fixtures_directory();

/// The data of a program that was installed: `program` is its path.
std::filesystem::path installed_fixtures(const std::filesystem::path& program);

/// In order, from a list separated by ':' as in $XDG_DATA_DIRS; empty or relative folders are left
/// out, as its specification says.
std::vector<std::filesystem::path> shared_fixtures(const std::string& data_folders);

}  // namespace contactcheck::scene
