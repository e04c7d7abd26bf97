// Numbers of things in sentences.
#pragma once

#include <cstdint>
#include <string>

namespace contactcheck::text {

/// "1 frame", "2 frames"; `many`: where it is not `one` with an s.
inline std::string counted(std::uint64_t n, const std::string& one, const std::string& many = "") {
  return std::to_string(n) + " " + (n == 1 ? one : many.empty() ? one + "s" : many);
}

}  // namespace contactcheck::text
