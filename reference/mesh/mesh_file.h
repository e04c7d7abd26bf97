// Meshes out of files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/mesh.h"
#include "reference/mesh/polygon_soup.h"

namespace contactcheck::mesh {

struct LoadedMesh {
  TriangleMesh mesh;
  std::string notes;  ///< "12 polygons split into triangles", "read as float", ...; may be empty
  /// Polygons of the file, ascending, that no triangles can fill, and that were not to be repaired.
  std::vector<std::size_t> unfilled = {};
};

/// What becomes of a polygon of five corners and more that crosses or folds back on itself, or is
/// concave with more than kMostConcaveCorners: it is left out, or repaired by the fan round its
/// first corner. A note names it either way.
enum class Folded : bool { kLeftOut, kFanned };

/// "2 vertices that no triangle uses, dropped"; nothing where there were none.
void add_note_of_dropped(std::string& notes, std::size_t vertices);

/// Reads OBJ, OFF, PLY and STL by their extension (any case) with doubles and indices kept
/// (polygon_soup.h), and every other extension through assimp as floats. Polygons become triangles
/// (polygon_split.h); for STL, corners at equal coordinates become one vertex. All coordinates are
/// finite and all indices in range.
/// @throws InputError, one sentence: file, what, and the vertex, face or line where it is known
LoadedMesh read_mesh_file(const std::filesystem::path& file, Folded folded = Folded::kLeftOut);

/// Vertices and faces as they stand in such a file: of a further frame of a mesh, whose faces are
/// already split. The corners of STL are not joined.
/// @throws as read_mesh_file()
PolygonSoup read_polygons(const std::filesystem::path& file);

/// Whether the file is STL, by its extension: each of its triangles has corners of its own.
bool has_own_corners(const std::filesystem::path& file);

/// The same as read_mesh_file() for bytes in memory; `name` stands for the file in messages: "mesh
/// file \"x.off\"".
LoadedMesh read_mesh_bytes(SoupFormat format, std::string_view bytes, const std::string& name,
                           Folded folded = Folded::kLeftOut);

}  // namespace contactcheck::mesh
