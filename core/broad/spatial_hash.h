// Spatial hashing of an infinite uniform grid.
// Source: Teschner, Heidelberger, Mueller, Pomeranets, Gross: Optimized Spatial Hashing for
// Collision Detection of Deformable Objects, VMV 2003: hash = (x p1) xor (y p2) xor (z p3) mod n.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types/vec3.h"

namespace contactcheck {

/// Integer coordinates of a grid cell: floor(p / h) per axis, towards minus infinity also for
/// negative coordinates; clamped to +-2^62, so every finite p has a key and keys are monotone in p.
struct GridKey {
  std::int64_t x = 0, y = 0, z = 0;
  auto operator<=>(const GridKey&) const = default;
};

template <typename T>
std::int64_t grid_coordinate(T x, T cell_size) {
  constexpr T kLimit = static_cast<T>(0x1p62);
  const T q = std::clamp(x / cell_size, -kLimit, kLimit);
  // floor() without the library call that it is on plain x86-64; the conversions are exact.
  const auto cut = static_cast<std::int64_t>(q);
  return cut - (static_cast<T>(cut) > q ? 1 : 0);
}

template <typename T>
GridKey grid_key(const Vec3Of<T>& p, T cell_size) {
  return {grid_coordinate(p.x(), cell_size), grid_coordinate(p.y(), cell_size),
          grid_coordinate(p.z(), cell_size)};
}

/// The largest power of two that 32 bits hold.
inline constexpr std::uint32_t kLargestHashTable = std::uint32_t{1} << 31;

/// Buckets of a table: `wanted`, or as many as entries (0), rounded up to a power of two, at least
/// one and at most kLargestHashTable.
/// @throws RefusedInput for more entries than 32 bits number
std::uint32_t hash_table_size(std::uint32_t wanted, std::uint64_t entries);

/// A table built once per frame. Keys that fall into one bucket are distinguished by their
/// coordinates, so what lookups find does not depend on the table's size.
class SpatialHash {
 public:
  struct Entry {
    GridKey key;
    std::uint32_t id = 0;
  };

  /// `table_size`: see hash_table_size().
  explicit SpatialHash(std::uint32_t table_size = 0) : wanted_size_(table_size) {}

  /// Keeps the memory, so a table reused from frame to frame does not allocate.
  void clear() { entries_.clear(); }
  void clear(std::uint32_t table_size) {
    clear();
    wanted_size_ = table_size;
  }
  void insert(const GridKey& key, std::uint32_t id) { entries_.push_back({key, id}); }
  /// To be called between the last insert and the first lookup. @throws as hash_table_size() does
  void build();
  /// All entries of the bucket of `key`. The caller skips those with other keys.
  std::span<const Entry> bucket(const GridKey& key) const { return bucket_at(slot(key)); }

  template <typename Visit>
  void for_each(const GridKey& key, Visit&& visit) const {
    for (const Entry& e : bucket(key))
      if (e.key == key) visit(e.id);
  }
  std::size_t size() const { return entries_.size(); }
  std::size_t bucket_count() const { return begin_.empty() ? 0 : begin_.size() - 1; }
  std::span<const Entry> bucket_at(std::size_t index) const {
    return std::span(sorted_).subspan(begin_[index], begin_[index + 1] - begin_[index]);
  }

 private:
  std::uint32_t slot(const GridKey& key) const {
    // Unsigned, so that large coordinates wrap instead of overflowing.
    const auto low = [](std::int64_t v) { return static_cast<std::uint32_t>(v); };
    return ((low(key.x) * 73856093u) ^ (low(key.y) * 19349663u) ^ (low(key.z) * 83492791u)) & mask_;
  }

  std::uint32_t wanted_size_;
  std::uint32_t mask_ = 0;
  std::vector<Entry> entries_, sorted_;
  std::vector<std::uint32_t> begin_, next_;
};

}  // namespace contactcheck
