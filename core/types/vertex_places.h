// Vertices at one place.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck {

/// For each vertex the first one with equal coordinates (-0 = 0), which may be itself. @pre finite
std::vector<std::uint32_t> first_at_place(std::span<const Vec3> vertices);

}  // namespace contactcheck
