#include "reference/timing/schedule.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace contactcheck::timing {
namespace {

// std::shuffle differs between standard libraries.
std::vector<std::size_t> shuffled(std::size_t count, std::mt19937_64& random) {
  std::vector<std::size_t> out(count);
  std::iota(out.begin(), out.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) std::swap(out[i - 1], out[random() % i]);
  return out;
}

}  // namespace

std::vector<std::size_t> draw_cold_frames(const std::vector<bool>& contact_frames,
                                          std::uint64_t seed) {
  constexpr std::size_t kColdFrames = 8;
  std::mt19937_64 random(seed);
  std::vector<std::size_t> out = shuffled(contact_frames.size(), random);
  // A frame with contact to the front, if there is any.
  std::stable_partition(out.begin(), out.end(), [&, found = false](std::size_t f) mutable {
    const bool first = contact_frames[f] && !found;
    found = found || contact_frames[f];
    return first;
  });
  out.resize(std::min(out.size(), kColdFrames));
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<std::size_t> draw_order(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  return shuffled(count, random);
}

}  // namespace contactcheck::timing
