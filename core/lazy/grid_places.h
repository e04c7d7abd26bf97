// Maps grid positions to list indices, in memory proportional to the list, not to the grid.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/deform/lattice.h"
#include "core/types/check.h"
#include "core/types/count.h"

namespace contactcheck {

/// A hash table with open addressing, at most half full: a binary search in the list costs several
/// times as much, for every cell that a patch meets.
class GridPlaces {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  GridPlaces() = default;
  /// @pre `list` contains no position twice
  /// @throws RefusedInput for 2^32 - 1 positions and more
  explicit GridPlaces(const std::vector<GridIndex>& list) {
    const std::uint32_t end = in_32_bits<RefusedInput>(list.size() + 1, "positions in a grid") - 1;
    slots_.resize(std::bit_ceil(2 * list.size() + 1));
    for (std::uint32_t place = 0; place < end; ++place) {
      std::size_t slot = first_slot(list[place]);
      while (slots_[slot].place != kNone) slot = next(slot);
      slots_[slot] = {list[place], place};
    }
  }

  /// The index of `at` in the list, or kNone.
  std::uint32_t find(const GridIndex& at) const {
    if (slots_.empty()) return kNone;
    std::size_t slot = first_slot(at);
    while (slots_[slot].place != kNone && slots_[slot].at != at) slot = next(slot);
    return slots_[slot].place;
  }

  std::size_t bytes() const { return slots_.capacity() * sizeof(Slot); }

 private:
  struct Slot {
    GridIndex at{};
    std::uint32_t place = kNone;
  };

  std::size_t next(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }
  std::size_t first_slot(const GridIndex& at) const {
    std::uint64_t h = at[0];
    for (const int k : {1, 2}) h = (h ^ (h >> 29)) * 0x9e3779b97f4a7c15u + at[k];
    h *= 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(h >> 32) & (slots_.size() - 1);
  }

  std::vector<Slot> slots_;  ///< empty, or a power of two of them
};

}  // namespace contactcheck
