#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace contactcheck {

/// Which pairs of bodies were reported already; for boolean questions.
class SeenPairs {
 public:
  explicit SeenPairs(std::size_t bodies) : bodies_(bodies), seen_(bodies * bodies, 0) {}
  bool seen(std::uint32_t a, std::uint32_t b) const { return seen_[a * bodies_ + b] != 0; }
  void mark(std::uint32_t a, std::uint32_t b) {
    seen_[a * bodies_ + b] = seen_[b * bodies_ + a] = 1;
  }

 private:
  std::size_t bodies_;
  std::vector<char> seen_;
};

}  // namespace contactcheck
