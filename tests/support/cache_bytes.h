// PC2 and MDD point caches as bytes, written apart from the reader.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck::test {

/// [sample][point]
using CacheSamples = std::vector<std::vector<Vec3>>;

inline std::string word_bytes(std::uint32_t value, bool big_endian) {
  std::string out;
  for (int i = 0; i < 4; ++i)
    out += static_cast<char>(value >> 8 * (big_endian ? 3 - i : i) & 0xff);
  return out;
}

inline std::string float_bytes(float value, bool big_endian) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return word_bytes(bits, big_endian);
}

inline std::string points_bytes(const CacheSamples& samples, bool big_endian) {
  std::string out;
  for (const auto& sample : samples)
    for (const Vec3& p : sample)
      for (int k = 0; k < 3; ++k) out += float_bytes(static_cast<float>(p[k]), big_endian);
  return out;
}

inline std::string pc2_bytes(const CacheSamples& samples) {
  return std::string("POINTCACHE2\0", 12) + word_bytes(1, false) +
         word_bytes(static_cast<std::uint32_t>(samples.front().size()), false) +
         float_bytes(0, false) + float_bytes(1, false) +
         word_bytes(static_cast<std::uint32_t>(samples.size()), false) +
         points_bytes(samples, false);
}

inline std::string mdd_bytes(const CacheSamples& samples) {
  std::string out = word_bytes(static_cast<std::uint32_t>(samples.size()), true) +
                    word_bytes(static_cast<std::uint32_t>(samples.front().size()), true);
  for (std::size_t i = 0; i < samples.size(); ++i)
    out += float_bytes(static_cast<float>(i) / 24.0f, true);
  return out + points_bytes(samples, true);
}

}  // namespace contactcheck::test
