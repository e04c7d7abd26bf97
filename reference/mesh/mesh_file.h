// Meshes out of files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/types/mesh.h"
#include "reference/mesh/polygon_soup.h"

namespace contactcheck::mesh {

struct LoadedMesh {
  TriangleMesh mesh;
  std::string notes;  ///< "12 polygons split into triangles", "read as float", ...; may be empty
};

/// Appends a remark to notes that are joined by "; ".
void add_note(std::string& notes, const std::string& note);
/// "2 vertices that no triangle uses, dropped"; nothing where there were none.
void add_note_of_dropped(std::string& notes, std::size_t vertices);

/// Reads OBJ, OFF, PLY and STL by their extension (any case) with doubles and indices kept, and
/// every other extension through assimp as floats. Polygons become triangles (polygon_split.h); for
/// STL, corners at equal coordinates become one vertex. All coordinates are finite and all indices
/// in range.
/// @throws InputError, one sentence: file, what, and the vertex, face or line where it is known
LoadedMesh read_mesh_file(const std::filesystem::path& file);

/// Vertices and faces (of three corners and more) as they stand in such a file: of a further frame
/// of a mesh, whose faces are already split. @throws as read_mesh_file()
PolygonSoup read_polygons(const std::filesystem::path& file);

/// The same as read_mesh_file() for bytes in memory; `name` stands for the file in messages: "mesh
/// file \"x.off\"".
LoadedMesh read_mesh_bytes(SoupFormat format, const std::string& bytes, const std::string& name);

}  // namespace contactcheck::mesh
