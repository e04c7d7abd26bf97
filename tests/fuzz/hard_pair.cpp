#include "tests/fuzz/hard_pair.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace contactcheck::test {
namespace {

class PairDecoder {
 public:
  explicit PairDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::vector<Vec3> corners(std::size_t count) {
    while (corners_.size() < count) {
      const Vec3 next = corner();
      corners_.push_back(next);
    }
    return corners_;
  }

 private:
  std::uint8_t byte() { return next_ < bytes_.size() ? bytes_[next_++] : std::uint8_t{0}; }
  int signed_byte() { return static_cast<std::int8_t>(byte()); }
  int axis() { return byte() % 3; }

  double any_bits() {
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    return std::bit_cast<double>(bits);
  }
  double few_bits() {
    const int mantissa = signed_byte();
    const int low = byte();
    return std::ldexp(mantissa, (signed_byte() * 256 + low) % 1082);
  }
  double special() {
    using Limits = std::numeric_limits<double>;
    constexpr double kValues[] = {0.0,
                                  Limits::denorm_min(),
                                  Limits::min(),
                                  Limits::max(),
                                  1.0,
                                  0x1.fffffffffffffp-1,
                                  1.0 + 0x1p-52,
                                  0.1,
                                  0.3,
                                  1.0 / 3.0,
                                  Limits::max() / 2,
                                  0x1p300};
    const int code = byte();
    const double value = kValues[code / 2 % std::size(kValues)];
    return code % 2 == 0 ? value : -value;
  }
  double coordinate() {
    switch (byte() % 4) {
      case 0:
        return signed_byte();
      case 1:
        return few_bits();
      case 2:
        return special();
      default:
        return any_bits();
    }
  }
  Vec3 free_corner() {
    const double x = coordinate(), y = coordinate();
    return {x, y, coordinate()};
  }

  const Vec3& earlier() { return corners_[byte() % corners_.size()]; }

  Vec3 nudged() {
    Vec3 out = earlier();
    double& value = out[axis()];
    const int ulps = signed_byte() % 16;
    const double end = std::copysign(std::numeric_limits<double>::infinity(), ulps);
    for (int i = 0; i < std::abs(ulps); ++i) value = std::nextafter(value, end);
    return out;
  }
  Vec3 on_line() {
    const Vec3 a = earlier(), b = earlier();
    return a + 0.25 * signed_byte() * (b - a);
  }
  Vec3 in_plane() {
    const Vec3 a = earlier(), b = earlier(), c = earlier();
    const double s = 0.25 * (signed_byte() % 9), t = 0.25 * (signed_byte() % 9);
    return a + s * (b - a) + t * (c - a);
  }
  Vec3 crossed() {
    Vec3 out = earlier();
    const int k = axis();
    out[k] = earlier()[k];
    return out;
  }
  Vec3 corner() {
    const int operation = byte() % 8;
    if (operation < 3 || corners_.empty()) return free_corner();
    switch (operation) {
      case 3:
        return earlier();
      case 4:
        return nudged();
      case 5:
        return on_line();
      case 6:
        return in_plane();
      default:
        return crossed();
    }
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t next_ = 0;
  std::vector<Vec3> corners_;
};

}  // namespace

std::optional<std::pair<TrianglePoints, TrianglePoints>> hard_pair(
    std::span<const std::uint8_t> bytes) {
  const std::vector<Vec3> c = PairDecoder(bytes).corners(6);
  if (!std::all_of(c.begin(), c.end(), [](const Vec3& v) { return v.allFinite(); }))
    return std::nullopt;
  return std::pair{TrianglePoints{c[0], c[1], c[2]}, TrianglePoints{c[3], c[4], c[5]}};
}

}  // namespace contactcheck::test
