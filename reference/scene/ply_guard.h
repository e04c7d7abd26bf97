// What CGAL's PLY reader may be given. That of CGAL 5.5.1 reads a length and allocates it, goes on
// with the next element after a list that it could not read, and casts by a property's name.
#pragma once

#include <optional>
#include <string>

namespace contactcheck {

/// The same values under a header of our own, in which only x, y, z and the vertex indices keep
/// their names. Nothing when a value is missing or does not fit its type, a coordinate is not
/// float or double, or vertex indices are not int or uint; and when x, y or z is missing or the
/// file goes on after its values, which `fault` then says as guarded_bytes does. In text each
/// element has a line of its own.
std::optional<std::string> plain_ply(const std::string& bytes, std::string& fault);

}  // namespace contactcheck
