// Limits counts to what 32-bit indices can number.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "core/types/check.h"

namespace contactcheck {

/// The largest number of items with 32-bit indices; the index past the last one fits, too.
inline constexpr std::uint64_t kMostNumbered = std::numeric_limits<std::uint32_t>::max();

/// Converts `count` to 32 bits. It never truncates: a truncated index would name another item.
/// @throws Error, naming `what` and the count, when it is above kMostNumbered
template <class Error>
std::uint32_t in_32_bits(std::uint64_t count, const char* what) {
  if (count > kMostNumbered)
    throw Error("there are " + std::to_string(count) + " " + what + "; at most " +
                std::to_string(kMostNumbered) + " can be numbered");
  return static_cast<std::uint32_t>(count);
}

}  // namespace contactcheck
