// A direction along which some points lie beyond others, at several times: a guess in doubles, for
// certificates that verify it exactly.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck::oracle::certify {

/// Points at one time. @pre both not empty
struct Clouds {
  std::vector<Vec3> p, q;
};

/// A direction n with n * p > n * q for all p and q of either time, up to rounding, and a smallest
/// difference not far below the largest possible. Nothing if none was found.
/// @pre coordinates of a magnitude near 1 at most
std::optional<Vec3> likely_direction(const std::array<Clouds, 2>& times);

}  // namespace contactcheck::oracle::certify
