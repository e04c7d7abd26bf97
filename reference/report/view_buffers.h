// The binary part of the view container: aligned little-endian arrays, named by references that
// stand in its JSON header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "core/types/vec3.h"

namespace contactcheck::report {

/// Bytes; where arrays and what stands before them begin.
inline constexpr std::size_t kViewAlignment = 4;

/// Every array starts at a multiple of 4 bytes from the first one. A reference is
/// {"type": "f32" | "u16" | "u32", "at": byte, "count": elements}.
class ViewBuffers {
 public:
  /// Rounded to the nearest single. @pre within its range
  nlohmann::ordered_json singles(std::span<const double> values);
  /// Three singles for each point.
  nlohmann::ordered_json points(std::span<const Vec3> values);
  /// As u16 where all values fit, as u32 elsewhere.
  nlohmann::ordered_json ids(std::span<const std::uint32_t> values);

  const std::string& bytes() const { return bytes_; }

 private:
  nlohmann::ordered_json reference(const char* type, std::size_t count);
  void append(std::uint32_t value, int size);
  void append(double value);

  std::string bytes_;
};

}  // namespace contactcheck::report
