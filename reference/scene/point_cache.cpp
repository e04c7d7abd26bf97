#include "reference/scene/point_cache.h"

#include <bit>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "core/types/check.h"
#include "reference/text/file_text.h"
#include "reference/text/words.h"

namespace contactcheck::scene {
namespace {

constexpr std::string_view kPc2Magic("POINTCACHE2\0", 12);
constexpr std::size_t kPc2Header = 32, kMddHeader = 8;
constexpr std::size_t kBytesOfPoint = 12;  // three floats
// int32 in both formats: what is above was negative.
constexpr std::uint32_t kLargestCount = 0x7fffffff;

}  // namespace

PointCache::PointCache(CacheFormat format, std::string bytes, std::string name)
    : format_(format), bytes_(std::move(bytes)), name_(std::move(name)) {
  if (format == CacheFormat::kPc2) {
    read_pc2();
  } else {
    read_mdd();
  }
}

void PointCache::refuse(const std::string& what) const {
  throw InputError(name_ + " " + what + ".");
}

void PointCache::require_bytes(std::size_t wanted, const char* what) const {
  if (bytes_.size() < wanted)
    refuse("has " + std::to_string(bytes_.size()) + " bytes; its " + what + " alone takes " +
           std::to_string(wanted));
}

void PointCache::require_finite(float value, const std::string& what) const {
  if (!std::isfinite(value)) refuse("has a " + what + " that is not a finite number");
}

std::uint32_t PointCache::word(std::size_t offset) const {
  return static_cast<std::uint32_t>(
      text::whole_of_bytes(std::string_view(bytes_).substr(offset, 4),
                           format_ == CacheFormat::kPc2 ? std::endian::little : std::endian::big));
}

float PointCache::number(std::size_t offset) const { return std::bit_cast<float>(word(offset)); }

void PointCache::read_pc2() {
  if (std::string_view(bytes_).substr(0, kPc2Magic.size()) != kPc2Magic)
    refuse("is no PC2 file: it does not begin with POINTCACHE2 and a zero byte");
  require_bytes(kPc2Header, "header");
  if (word(12) != 1) refuse("has version " + std::to_string(word(12)) + "; only 1 is known");
  require_finite(number(20), "first frame");
  require_finite(number(24), "number of frames per sample");
  take_counts(word(16), word(28), kPc2Header);
}

void PointCache::read_mdd() {
  require_bytes(kMddHeader, "header");
  const std::uint32_t samples = word(0), points = word(4);
  const std::size_t rest = bytes_.size() - kMddHeader;
  if (samples <= kLargestCount && samples > rest / 4)
    refuse("claims " + std::to_string(samples) + " samples, more than its " +
           std::to_string(bytes_.size()) + " bytes can hold");
  const std::size_t times = samples <= kLargestCount ? samples : 0;
  take_counts(points, samples, kMddHeader + 4 * times);
  for (std::size_t i = 0; i < samples_; ++i)
    require_finite(number(kMddHeader + 4 * i), "time of sample " + std::to_string(i));
}

// Counts are of 31 bits and the points' bytes of 35: nothing overflows.
void PointCache::take_counts(std::uint32_t points, std::uint32_t samples, std::size_t header) {
  const auto check = [&](std::uint32_t count, const char* of) {
    if (count == 0 || count > kLargestCount)
      refuse("claims " + std::to_string(static_cast<std::int32_t>(count)) + " " + of +
             "; it must have at least 1");
  };
  check(points, "points");
  check(samples, "samples");
  const std::size_t bytes_of_sample = kBytesOfPoint * points, rest = bytes_.size() - header;
  if (rest / bytes_of_sample < samples)
    refuse("claims " + std::to_string(samples) + " samples of " + std::to_string(points) +
           " points, but has only " + std::to_string(rest / bytes_of_sample) + " of them in its " +
           std::to_string(bytes_.size()) + " bytes");
  if (const std::size_t more = rest - samples * bytes_of_sample; more > 0)
    refuse("has " + std::to_string(more) + " bytes more than its " + std::to_string(samples) +
           " samples of " + std::to_string(points) + " points");
  points_ = points;
  samples_ = samples;
  begin_ = header;
}

std::size_t PointCache::still_samples() const {
  const std::size_t size = kBytesOfPoint * points_;
  const std::string_view bytes = std::string_view(bytes_).substr(begin_);
  const std::string_view last = bytes.substr((samples_ - 1) * size);
  std::size_t still = 1;
  while (still < samples_ && bytes.substr((samples_ - 1 - still) * size, size) == last) ++still;
  return still;
}

std::vector<Vec3> PointCache::sample(std::size_t index) const {
  CONTACTCHECK_INVARIANT(index < samples_, "the cache has this sample");
  std::vector<Vec3> out(points_);
  for (std::size_t p = 0; p < points_; ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      const float value = number(begin_ + (index * points_ + p) * kBytesOfPoint + 4 * k);
      if (!std::isfinite(value))
        refuse("sample " + std::to_string(index) + ", point " + std::to_string(p) + ": its " +
               "xyz"[k] + " is not a finite number");
      out[p][static_cast<Eigen::Index>(k)] = value;
    }
  return out;
}

namespace {

std::optional<CacheFormat> cache_format_of(const std::filesystem::path& file) {
  const std::string extension = text::lower_extension(file);
  if (extension == ".pc2") return CacheFormat::kPc2;
  if (extension == ".mdd") return CacheFormat::kMdd;
  return std::nullopt;
}

}  // namespace

bool is_point_cache(const std::filesystem::path& file) { return cache_format_of(file).has_value(); }

PointCache read_point_cache(const std::filesystem::path& file) {
  const std::string name = "point cache " + text::in_quotes(file.string());
  const std::optional<CacheFormat> format = cache_format_of(file);
  if (!format) throw InputError(name + " is neither .pc2 nor .mdd.");
  return PointCache(*format, text::read_file_bytes(file, "point cache", text::kLongestMesh), name);
}

}  // namespace contactcheck::scene
