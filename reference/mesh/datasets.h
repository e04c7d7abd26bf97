// Real meshes out of Debian's libcgal-demo. They are never copied into this repository.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reference/mesh/data_package.h"
#include "reference/mesh/mesh_file.h"

namespace contactcheck::mesh {

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
