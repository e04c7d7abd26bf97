#include "core/broad/spatial_hash.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace contactcheck {

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

}  // namespace contactcheck
