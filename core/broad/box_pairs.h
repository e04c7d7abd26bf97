// Finds all overlapping pairs of axis-aligned boxes of different bodies, or within each body, by
// spatial hashing.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/broad/spatial_hash.h"
#include "core/types/vec3.h"

namespace contactcheck {

template <typename T>
struct OwnedBoxOf {
  AabbOf<T> box;
  std::uint32_t body = 0;
  std::uint32_t cell = 0;
};
using OwnedBox = OwnedBoxOf<double>;

struct BoxPairSettings {
  double cell_size = 1.0;               ///< metres, of the hash grid
  std::uint32_t table_size = 0;         ///< see SpatialHash
  double largest_buckets_per_box = 64;  ///< a box that meets more goes to the oversize list
  bool own = false;                     ///< true: pairs within bodies, instead of between them
};

/// T: double or float, also for grid keys. Complete and without repeats: an AABB is put into every
/// bucket it meets, and a pair is taken only in the bucket of the lower corner of the two boxes'
/// intersection, which both meet. Boxes that meet too many buckets are tested against all others.
template <typename T>
class BoxPairFinderOf {
 public:
  using Boxes = std::vector<OwnedBoxOf<T>>;
  using Pair = std::pair<std::uint32_t, std::uint32_t>;  ///< indices into `boxes`, first < second

  /// Appends every closed overlap of boxes of different bodies, or (settings.own) of one body.
  void find(const Boxes& boxes, const BoxPairSettings& settings, std::vector<Pair>& out);
  /// Comparisons of the last find(): of two entries of a bucket, and of an oversize box with each
  /// box.
  std::uint64_t visited() const { return visited_; }

 private:
  void hash_boxes(const Boxes& boxes, const BoxPairSettings& settings);
  void pairs_in_buckets(const Boxes& boxes, const BoxPairSettings& settings,
                        std::vector<Pair>& out);
  void pairs_of_oversize(const Boxes& boxes, bool own, std::vector<Pair>& out);

  SpatialHash hash_;
  std::vector<std::uint32_t> oversize_;
  std::vector<char> is_oversize_;
  std::uint64_t visited_ = 0;
};
using BoxPairFinder = BoxPairFinderOf<double>;

}  // namespace contactcheck
