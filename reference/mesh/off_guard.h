// What CGAL's OFF reader may be given: that of CGAL 5.5.1 reads a colour that is not there beyond
// the end of a line, and allocates a polygon before its corners are read, whatever its length.
#pragma once

#include <optional>
#include <string>

namespace contactcheck::mesh {

/// The same vertices and faces without normals, colours and texture coordinates. Nothing when the
/// file names a size that it does not hold or holds more than it names, is binary or not
/// three-dimensional. `fault` is then, where it is known, how a sentence goes on after the file's
/// name: " has 1 line more than its 4 vertices and 4 faces".
std::optional<std::string> plain_off(const std::string& bytes, std::string& fault);

}  // namespace contactcheck::mesh
