// What a mesh file's bytes themselves tell: where a number is not finite, and how many faces the
// file claims. Readers fail without a reason or lose faces; these checks find the place.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "reference/mesh/polygon_soup.h"

namespace contactcheck::mesh {

/// The first coordinate of a text file that is no finite number, as the end of a sentence:
/// "vertex 17 has the coordinate nan (line 19); coordinates must be finite numbers". For binary
/// STL, names triangle and corner. Empty when none is found. Assumes one vertex per line.
std::string coordinate_fault(SoupFormat format, const std::string& bytes);

/// How a sentence goes on after the name of a binary STL file that is longer than its triangles:
/// " has 50 bytes more than its 4 triangles". Empty for others. (Readers drop what follows.)
std::string bytes_beyond_stl(const std::string& bytes);

struct SoupCounts {
  std::size_t vertices = 0, faces = 0;
};

/// The numbers of vertices and faces that an ASCII OFF or PLY file's header claims; nothing for
/// other formats and for headers of another form.
std::optional<SoupCounts> claimed_counts(SoupFormat format, const std::string& bytes);

/// The first OBJ face with an index that is no whole number or no vertex of the file, as the end of
/// a sentence: "face 2 (line 10) names the vertex 5; the file has 4". Empty when there is none, or
/// for other formats. CGAL's OBJ reader takes 1.9 for 1 and 0 for the vertex after the last.
std::string face_index_fault(SoupFormat format, const std::string& bytes);

/// The first OBJ face line whose number of corners is not what was read: its line number. Zero when
/// all agree, or for other formats. CGAL's OBJ reader stops silently in the middle of a face.
std::size_t face_line_fault(SoupFormat format, const std::string& bytes, const PolygonSoup& soup);

}  // namespace contactcheck::mesh
