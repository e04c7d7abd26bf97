// A surface as PLY, in doubles: the bits of the vertices that were judged.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/types/mesh.h"

namespace contactcheck::certify {

/// A binary little-endian PLY file: x, y, z as doubles in metres, faces as lists of three ints.
/// `comment`, one line, says what it is.
std::string ply_bytes(std::span<const Vec3> vertices, const std::vector<Triangle>& triangles,
                      const std::string& comment);

}  // namespace contactcheck::certify
