// Own reader of PLY: CGAL 5.5.1's allocates the length that a list claims, goes on with the next
// element after a list that it could not read, and casts by a property's name.
#pragma once

#include <string>

#include "reference/mesh/polygon_soup.h"

namespace contactcheck::mesh {

/// Vertices and faces of a PLY file, text or binary; the values of floats are those of the floats.
/// False when a value is missing or does not fit its type, a coordinate is not float or double, or
/// vertex indices are not lists of int or uint; and when x, y or z is missing or the file goes on
/// after its values, which `fault` then says, as a sentence goes on after the file's name. In text
/// each element is one line.
bool read_ply(const std::string& bytes, PolygonSoup& out, std::string& fault);

}  // namespace contactcheck::mesh
