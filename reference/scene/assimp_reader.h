// The mesh formats that CGAL does not read (glTF, Collada, FBX, 3DS, ...), through assimp.
#pragma once

#include <filesystem>

#include "reference/scene/mesh_file.h"

namespace contactcheck {

/// Coordinates are floats (assimp 5.2.5) and the notes say so. Node transforms are applied, the
/// meshes of the file become one, and vertices at bit-identical places become one: such formats
/// split a vertex for each of its normals and texture coordinates, which would tear a closed
/// surface open. Nothing else is joined, unlike assimp's own joining, which merges what is 1e-6
/// apart.
/// @throws InputError with assimp's reason
LoadedMesh read_with_assimp(const std::filesystem::path& file);

}  // namespace contactcheck
