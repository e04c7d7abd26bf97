// Reads meshes from files.
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
  /// Polygons of the file, ascending, that were left without triangles and not repaired.
  std::vector<std::size_t> unfilled = {};
};

/// What happens to a polygon of five or more corners that crosses or folds back on itself, or is
/// concave with more than kMostConcaveCorners: it is left out, or repaired by the fan round its
/// first corner. Either way a note names it.
enum class Folded : bool { kLeftOut, kFanned };

/// Adds "2 vertices that no triangle uses, dropped"; nothing for 0.
void add_note_of_dropped(std::string& notes, std::size_t vertices);

/// Reads OBJ, OFF, PLY and STL by their extension (any case) with doubles and indices kept
/// (polygon_soup.h), and every other extension through assimp as floats. Polygons become triangles
/// (polygon_split.h); for STL, corners at equal coordinates become one vertex. All coordinates are
/// finite and all indices in range.
/// @throws InputError, one sentence: file, defect, and the vertex, face or line if there is one
LoadedMesh read_mesh_file(const std::filesystem::path& file, Folded folded = Folded::kLeftOut);

/// The vertices and faces as in the file, for further frames of a mesh whose faces are already
/// split. The corners of STL are not joined.
/// @throws as read_mesh_file()
PolygonSoup read_polygons(const std::filesystem::path& file);

/// True for STL, by extension: each of its triangles has separate corners.
bool has_own_corners(const std::filesystem::path& file);

/// The same as read_mesh_file() for bytes in memory; `name` denotes the file in messages: "mesh
/// file \"x.off\"".
LoadedMesh read_mesh_bytes(SoupFormat format, std::string_view bytes, const std::string& name,
                           Folded folded = Folded::kLeftOut);

}  // namespace contactcheck::mesh
