// Moves that make the coordinates of a candidate simpler, one at a time or many at once.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace contactcheck::reduce {

/// x, y, z of all vertices after one another, those of the first mesh first.
using Coordinates = std::vector<double>;

/// What is made smaller: the complexity of every coordinate (simple_number.h), and 3 for every
/// value that occurs along an axis.
long reading_cost(const Coordinates& coordinates);

/// Whole sets of coordinates of less cost than `now`, all finite and different from one another, in
/// the order in which they should be tried: exact ones (no rounding) first, then by cost.
/// Every vertex, and every value along an axis, moved to the origin.
std::vector<Coordinates> translations(const Coordinates& now);
/// All coordinates, or those along an axis, times a power of two or divided by one of them.
std::vector<Coordinates> scalings(const Coordinates& now);
/// The values along one axis or all axes replaced by their ranks; an axis mirrored.
std::vector<Coordinates> rankings(const Coordinates& now);
/// All coordinates, those of one mesh, axis or vertex rounded to a grid, to fewer bits or to fewer
/// decimal digits. `first`: coordinates of the first mesh.
std::vector<Coordinates> roundings(const Coordinates& now, std::size_t first);
/// All coordinates of one value along an axis replaced by a simpler one.
std::vector<Coordinates> replaced_values(const Coordinates& now);
/// One coordinate replaced by a simpler number, or by another one along its axis.
std::vector<Coordinates> replaced_coordinate(const Coordinates& now, std::size_t index);

/// Makes the coordinates simpler as long as a move of less cost shows, in rounds over the moves
/// above in their order. Ends by itself, as costs fall; or where `may_go_on` turns false.
/// @pre `start` shows
Coordinates simplify(Coordinates start, std::size_t first,
                     const std::function<bool(const Coordinates&)>& shows,
                     const std::function<bool()>& may_go_on);

}  // namespace contactcheck::reduce
