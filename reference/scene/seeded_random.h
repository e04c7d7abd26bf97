// Random numbers by seed, number of the scene and name of the parameter, so that a parameter keeps
// its value when others are added. Only sums, products, quotients and square roots are used: the
// same bits on every machine.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/types/hash.h"
#include "core/types/vec3.h"
#include "reference/scene/split_mix.h"

namespace contactcheck::scene {

/// Uniform on the unit sphere of N dimensions: drawn in the ball, not too near its centre, and
/// normalised. `draw`: uniform in [-1, 1).
template <std::size_t N, typename Draw>
std::array<double, N> drawn_on_sphere(Draw&& draw) {
  while (true) {
    std::array<double, N> v;
    double squared = 0.0;
    for (double& x : v) {
      x = draw();
      squared += x * x;
    }
    if (squared > 1.0 || squared < 1e-3) continue;
    const double length = std::sqrt(squared);
    for (double& x : v) x /= length;
    return v;
  }
}

class SeededRandom {
 public:
  SeededRandom(std::uint64_t seed, std::uint64_t scene, std::uint64_t attempt,
               std::string_view name)
      : mix_(hash_of(seed, scene, attempt, name)) {
    bits();  // FNV leaves the last letters of a name in the low bits alone
  }

  std::uint64_t bits() { return mix_.bits(); }
  /// In [0, 1).
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Uniform in its logarithm: low * (high / low)^u, the power by the square roots that the binary
  /// digits of u name. @pre 0 < low <= high
  double log_between(double low, double high) {
    double power = 1.0, root = high / low;
    for (std::uint64_t digits = bits() >> 32, k = 0; k < 32; ++k) {
      root = std::sqrt(root);
      if ((digits >> (31 - k)) & 1) power *= root;
    }
    return low * power;
  }
  /// 0 .. count - 1. @pre 0 < count < 2^32
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(((bits() >> 32) * count) >> 32);
  }
  std::size_t whole(std::size_t low, std::size_t high) { return low + below(high - low + 1); }

  Vec3 direction() {
    const auto v = drawn_on_sphere<3>([this] { return between(-1.0, 1.0); });
    return {v[0], v[1], v[2]};
  }
  /// A uniform rotation as two half turns, about these axes one after the other: half turns need
  /// no sine. From a uniform unit quaternion (w, v): a is across v, and b = (w, v) a.
  std::array<Vec3, 2> rotation() {
    const auto q = drawn_on_sphere<4>([this] { return between(-1.0, 1.0); });
    const Vec3 v(q[1], q[2], q[3]);
    int least = 0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(v[k]) < std::abs(v[least])) least = k;
    Vec3 a = v.cross(Vec3::Unit(least));
    const double length = std::sqrt(a.x() * a.x() + a.y() * a.y() + a.z() * a.z());
    a = length > 1e-9 ? Vec3(a / length) : Vec3(Vec3::Unit(least));
    const Vec3 across = v.cross(a);
    return {a, q[0] * a + across};
  }

 private:
  static std::uint64_t hash_of(std::uint64_t seed, std::uint64_t scene, std::uint64_t attempt,
                               std::string_view name) {
    Fnv1a hash;
    for (const std::uint64_t key : {seed, scene, attempt}) hash.value(key);
    hash.bytes(name.data(), name.size());
    return hash.digest();
  }

  SplitMix64 mix_;
};

}  // namespace contactcheck::scene
