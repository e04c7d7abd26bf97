#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "core/narrow/triangle_triangle.h"

namespace contactcheck::test {

/// Reads bytes as a pair of triangles, so that few of them make a hard one: corners that are
/// shared, an ulp apart, on an edge or in the plane of others; coordinates with few bits, at the
/// ends of the range of doubles, or any 64 bits. Bytes beyond the end read as zero.
///
/// A corner is an operation (its low three bits) and its operands: 0 to 2 three coordinates; 3 an
/// earlier corner; 4 an earlier corner, one coordinate some ulps off; 5 a point of the line, 6 one
/// of the plane, through the corners before it, in quarters; 7 an earlier corner, one coordinate
/// taken from another. A coordinate is an operation (its low two bits) and its operand: 0 a small
/// whole number, 1 a mantissa of eight bits and an exponent, 2 a value of a table, 3 eight bytes.
///
/// Nothing when a coordinate is not finite.
std::optional<std::pair<TrianglePoints, TrianglePoints>> hard_pair(
    std::span<const std::uint8_t> bytes);

}  // namespace contactcheck::test
