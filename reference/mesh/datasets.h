// Meshes from Debian's libcgal-demo, and where the data of Debian packages is found. The meshes are
// never copied into this repository.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reference/mesh/mesh_file.h"

namespace contactcheck::mesh {

/// The folders that replace "/" when a package's file is searched, in order: $CONTACTCHECK_DATA
/// only, if set; else "/" and ${XDG_CACHE_HOME:-~/.cache}/contactcheck, into which .ci/setup
/// unpacks packages on images without /usr/share/doc.
std::vector<std::filesystem::path> data_roots();

/// The first existing file root / `path`. `path` is relative to "/" ("usr/share/doc/...").
/// @throws InputError, one sentence that names the Debian package and how to install it
std::filesystem::path find_package_file(const std::vector<std::filesystem::path>& roots,
                                        const std::string& package, const std::string& path);

/// The bytes of the regular file `member` of a tar archive, with or without gzip; nothing if the
/// archive has no such file.
/// @throws InputError if the archive cannot be read, is damaged or truncated
std::optional<std::string> read_tar_member(const std::filesystem::path& archive,
                                           const std::string& member);

/// Names that lists show: closed manifolds of some size. load_dataset() takes every OFF file of the
/// package.
const std::vector<std::string>& known_datasets();

/// The mesh data/meshes/NAME.off of the package's data.tar.gz.
/// @throws InputError when the package is missing or has no such mesh
LoadedMesh load_dataset(const std::string& name,
                        const std::vector<std::filesystem::path>& roots = data_roots());

}  // namespace contactcheck::mesh
