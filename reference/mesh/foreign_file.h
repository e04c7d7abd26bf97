// Reads other mesh formats through assimp.
#pragma once

#include <filesystem>
#include <string>

#include "reference/mesh/mesh_file.h"

namespace contactcheck::mesh {

/// Coordinates are floats (assimp 5.2.5), and the notes say so. Node transforms are applied and all
/// meshes of the file become one. Vertices at bit-identical places become one: such formats split a
/// vertex for each of its normals and texture coordinates, which would open a closed surface.
/// Nothing else is joined; assimp's own joining merges vertices within 1e-6. Animations are left
/// out, with a note. `name`: "mesh file \"a.glb\"".
/// @throws InputError with assimp's reason and the formats that can be read
LoadedMesh read_foreign_file(const std::filesystem::path& file, const std::string& name);

}  // namespace contactcheck::mesh
