// Finds vertices with equal coordinates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck {

/// Per vertex the lowest index of a vertex with equal coordinates (-0 = 0), or its own. @pre finite
std::vector<std::uint32_t> first_at_place(std::span<const Vec3> vertices);

}  // namespace contactcheck
