// Real meshes out of Debian's libcgal-demo, and where the data of Debian packages lies. The meshes
// are never copied into this repository.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reference/mesh/mesh_file.h"

namespace contactcheck::mesh {

/// The folders that stand for "/" when a package's file is looked for, in order: $CONTACTCHECK_DATA
/// alone when it is set; else "/" and ${XDG_CACHE_HOME:-~/.cache}/contactcheck, where .ci/setup
/// unpacks the packages on images that leave /usr/share/doc out.
std::vector<std::filesystem::path> data_roots();

/// The first root / `path` that is a file. `path` is relative to "/" ("usr/share/doc/...").
/// @throws InputError, one sentence that names the Debian package and how to install it
std::filesystem::path find_package_file(const std::vector<std::filesystem::path>& roots,
                                        const std::string& package, const std::string& path);

/// The bytes of the regular file `member` of a tar archive, packed by gzip or
/// not, or nothing when the archive has none of that name.
/// @throws InputError when the archive cannot be read, is damaged or ends early
std::optional<std::string> read_tar_member(const std::filesystem::path& archive,
                                           const std::string& member);

/// Names worth showing: closed manifolds of some size. load_dataset() takes every OFF file of the
/// package.
const std::vector<std::string>& known_datasets();

/// The mesh data/meshes/NAME.off of the package's data.tar.gz.
/// @throws InputError when the package is missing or has no such mesh
LoadedMesh load_dataset(const std::string& name,
                        const std::vector<std::filesystem::path>& roots = data_roots());

}  // namespace contactcheck::mesh
