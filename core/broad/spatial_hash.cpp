#include "core/broad/spatial_hash.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace contactcheck {
namespace {

std::int64_t grid_coordinate(double x, double cell_size) {
  constexpr double kLimit = 0x1p62;
  return static_cast<std::int64_t>(std::clamp(std::floor(x / cell_size), -kLimit, kLimit));
}

}  // namespace

GridKey grid_key(const Vec3& p, double cell_size) {
  return {grid_coordinate(p.x(), cell_size), grid_coordinate(p.y(), cell_size),
          grid_coordinate(p.z(), cell_size)};
}

std::uint32_t SpatialHash::slot(const GridKey& key) const {
  // Unsigned, so that large coordinates wrap instead of overflowing.
  const auto low = [](std::int64_t v) { return static_cast<std::uint32_t>(v); };
  return ((low(key.x) * 73856093u) ^ (low(key.y) * 19349663u) ^ (low(key.z) * 83492791u)) & mask_;
}

void SpatialHash::build() {
  const auto wanted = wanted_size_ > 0
                          ? wanted_size_
                          : static_cast<std::uint32_t>(std::max<std::size_t>(1, entries_.size()));
  const std::uint32_t size = std::bit_ceil(wanted);
  mask_ = size - 1;
  begin_.assign(size + 1, 0);
  for (const Entry& e : entries_) ++begin_[slot(e.key) + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  sorted_.resize(entries_.size());
  next_.assign(begin_.begin(), begin_.end() - 1);
  for (const Entry& e : entries_) sorted_[next_[slot(e.key)]++] = e;
}

std::span<const SpatialHash::Entry> SpatialHash::bucket(const GridKey& key) const {
  return bucket_at(slot(key));
}

}  // namespace contactcheck
