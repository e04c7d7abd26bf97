// Point caches: positions of the same points per sample, as animation programs write them.
//
// PC2 (Point Cache 2), little-endian: "POINTCACHE2" and a zero byte, int32 version (1), int32
// points, float first frame, float frames per sample, int32 samples; then per sample x y z of each
// point as floats. MDD (Lightwave), big-endian: int32 samples, int32 points, a float time per
// sample; then the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck::scene {

enum class CacheFormat { kPc2, kMdd };

class PointCache {
 public:
  /// `name` denotes the file in messages: "point cache \"cloth.pc2\"".
  /// @throws InputError, one sentence, if the header does not match the format or contains a
  /// non-finite number, or if the number of bytes differs from what its counts need (checked before
  /// any allocation)
  PointCache(CacheFormat format, std::string bytes, std::string name);

  std::size_t points() const { return points_; }    ///< at least 1
  std::size_t samples() const { return samples_; }  ///< at least 1
  /// The number of samples at the end that are equal bit for bit; at least 1.
  std::size_t still_samples() const;
  /// The points of a sample: floats of the file, widened. @pre index < samples()
  /// @throws InputError with sample and point if a coordinate is not finite
  std::vector<Vec3> sample(std::size_t index) const;

 private:
  void read_pc2();
  void read_mdd();
  void take_counts(std::uint32_t points, std::uint32_t samples, std::size_t header);
  void require_bytes(std::size_t wanted, const char* what) const;
  void require_finite(float value, const std::string& what) const;
  std::uint32_t word(std::size_t offset) const;
  float number(std::size_t offset) const;
  [[noreturn]] void refuse(const std::string& what) const;

  CacheFormat format_;
  std::string bytes_, name_;
  std::size_t points_ = 0, samples_ = 0, begin_ = 0;
};

/// Decided by the extension (any case).
bool is_point_cache(const std::filesystem::path& file);

/// Decided by the extension, .pc2 or .mdd (any case). @throws InputError
PointCache read_point_cache(const std::filesystem::path& file);

}  // namespace contactcheck::scene
