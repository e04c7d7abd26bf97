// Real meshes out of Debian's libcgal-demo. They are never copied into this repository.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reference/scene/data_package.h"
#include "reference/scene/mesh_file.h"

namespace contactcheck {

/// Names worth showing: closed manifolds of some size. load_dataset() takes every OFF file of the
/// package.
const std::vector<std::string>& known_datasets();

/// The mesh data/meshes/NAME.off of the package's data.tar.gz.
/// @throws InputError when the package is missing or has no such mesh
LoadedMesh load_dataset(const std::string& name,
                        const std::vector<std::filesystem::path>& roots = data_roots());

}  // namespace contactcheck
