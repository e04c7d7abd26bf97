// Polygon soups out of the bytes of OBJ, OFF and STL files, through CGAL's readers (LGPL), which
// keep doubles and indices (PLY: ply.h). The only translation unit with CGAL in this folder.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck::mesh {

enum class SoupFormat { kObj, kOff, kPly, kStl };

const char* name_of(SoupFormat format);

struct PolygonSoup {
  std::vector<Vec3> points;
  /// Indices may lie outside `points`: the caller checks. Polygons may have fewer than three
  /// corners.
  std::vector<std::vector<std::uint32_t>> polygons;
};

/// False when the reader refuses the bytes, and for PLY; it does not say why. For STL, corners at
/// equal coordinates become one point.
bool read_polygon_soup(SoupFormat format, const std::string& bytes, PolygonSoup& out);

}  // namespace contactcheck::mesh
