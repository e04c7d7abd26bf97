// What CGAL's readers may be given. Those of CGAL 5.5.1 trust a file: a colour that is not there is
// read beyond the end of a line, a list or a polygon is allocated before its corners are read,
// whatever its length, and what a property is called decides to which type it is cast.
#pragma once

#include <optional>
#include <string>

#include "reference/mesh/polygon_soup.h"

namespace contactcheck::mesh {

/// The bytes to read: OFF without normals, colours and texture coordinates, PLY with only what is
/// wanted under its name, other formats as they are. Nothing when OFF or PLY names a size that the
/// file does not hold or holds more than it names, and for OFF that is binary or not
/// three-dimensional. `fault` is then, where it is known, how a sentence goes on after the file's
/// name: " has 1 line more than its 4 vertices and 4 faces".
std::optional<std::string> guarded_bytes(SoupFormat format, const std::string& bytes,
                                         std::string& fault);

}  // namespace contactcheck::mesh
