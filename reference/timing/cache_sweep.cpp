#include "reference/timing/cache_sweep.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace contactcheck::timing {
namespace {

constexpr std::size_t kLongestSweep = std::size_t{64} << 20;

// "32768K"; 0 where there is no such file.
std::size_t size_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::size_t size = 0;
  char unit = ' ';
  if (!(in >> size)) return 0;
  in >> unit;
  return unit == 'K' ? size << 10 : unit == 'M' ? size << 20 : size;
}

}  // namespace

std::size_t sweep_bytes() {
  std::size_t largest = 0;
  for (int index = 0; index < 8; ++index)
    largest = std::max(largest, size_in("/sys/devices/system/cpu/cpu0/cache/index" +
                                        std::to_string(index) + "/size"));
  return largest == 0 ? kLongestSweep : std::min(2 * largest, kLongestSweep);
}

void CacheSweep::run() {
  constexpr std::size_t kLine = 64 / sizeof(std::uint64_t);
  for (std::size_t i = 0; i < buffer_.size(); i += kLine) sum_ += buffer_[i];
  // Keeps the optimiser from removing the loop.
  volatile std::uint64_t sink = sum_;
  (void)sink;
}

}  // namespace contactcheck::timing
