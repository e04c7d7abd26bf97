// Random numbers with a fixed definition: the same pairs on every machine and with every library.
//
// SplitMix64: G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators",
// OOPSLA 2014.
#pragma once

#include <cstdint>

namespace contactcheck::scene {

class PairRandom {
 public:
  /// Every stream of a seed is a sequence of its own: any pair can be made without those before it.
  PairRandom(std::uint64_t seed, std::uint64_t stream) : state_(mixed(mixed(seed) + stream)) {}

  std::uint64_t bits() { return mixed(state_ += 0x9e3779b97f4a7c15ull); }
  /// Uniform in 0 .. count - 1 (up to a bias of count / 2^64).
  int below(int count) { return static_cast<int>(bits() % static_cast<std::uint64_t>(count)); }
  /// Both ends included.
  int between(int least, int most) { return least + below(most - least + 1); }
  bool coin() { return below(2) == 0; }
  /// Uniform in [low, high), in steps of (high - low) / 2^53.
  double between(double low, double high) {
    return low + static_cast<double>(bits() >> 11) * 0x1p-53 * (high - low);
  }

 private:
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace contactcheck::scene
