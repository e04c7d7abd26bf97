// Empties the caches before a cold frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace contactcheck::timing {

/// Twice the largest cache of this machine's first core, as the kernel reports it, and at most 64
/// MiB; 64 MiB if it reports none.
std::size_t sweep_bytes();

/// Reads a buffer, so that the next call finds little of its data in the caches.
class CacheSweep {
 public:
  explicit CacheSweep(std::size_t bytes) : buffer_(bytes / sizeof(std::uint64_t), 1) {}
  void run();
  /// In all: each line adds a word of the buffer, which is 1.
  std::uint64_t lines_read() const { return sum_; }

 private:
  std::vector<std::uint64_t> buffer_;
  std::uint64_t sum_ = 0;
};

}  // namespace contactcheck::timing
