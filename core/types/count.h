// Counts of what is numbered by 32 bits.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "core/types/check.h"

namespace contactcheck {

/// Of things that are numbered by 32 bits, with room for the number behind the last.
inline constexpr std::uint64_t kMostNumbered = std::numeric_limits<std::uint32_t>::max();

/// `count` as 32 bits: a number that was cut would name something else.
/// @throws Error, naming `what` and the count, when it is above kMostNumbered
template <class Error>
std::uint32_t in_32_bits(std::uint64_t count, const char* what) {
  if (count > kMostNumbered)
    throw Error("there are " + std::to_string(count) + " " + what + "; at most " +
                std::to_string(kMostNumbered) + " can be numbered");
  return static_cast<std::uint32_t>(count);
}

}  // namespace contactcheck
