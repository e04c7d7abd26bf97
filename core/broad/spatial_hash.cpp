#include "core/broad/spatial_hash.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "core/types/check.h"
#include "core/types/count.h"

namespace contactcheck {

std::uint32_t hash_table_size(std::uint32_t wanted, std::uint64_t entries) {
  const std::uint32_t count = in_32_bits<RefusedInput>(entries, "entries of the spatial hash");
  return std::bit_ceil(std::min(wanted > 0 ? wanted : std::max(1u, count), kLargestHashTable));
}

void SpatialHash::build() {
  const std::uint32_t size = hash_table_size(wanted_size_, entries_.size());
  mask_ = size - 1;
  begin_.assign(std::size_t{size} + 1, 0);
  for (const Entry& e : entries_) ++begin_[slot(e.key) + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  sorted_.resize(entries_.size());
  next_.assign(begin_.begin(), begin_.end() - 1);
  for (const Entry& e : entries_) sorted_[next_[slot(e.key)]++] = e;
}

}  // namespace contactcheck
