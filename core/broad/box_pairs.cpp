#include "core/broad/box_pairs.h"

namespace contactcheck {
namespace {

double buckets_met(const GridKey& lo, const GridKey& hi) {
  // In double: the product of three spans of up to 2^63 must not overflow.
  const auto span = [](std::int64_t a, std::int64_t b) {
    return static_cast<double>(b) - static_cast<double>(a) + 1.0;
  };
  return span(lo.x, hi.x) * span(lo.y, hi.y) * span(lo.z, hi.z);
}

}  // namespace

template <typename T>
void BoxPairFinderOf<T>::find(const Boxes& boxes, const BoxPairSettings& settings,
                              std::vector<Pair>& out) {
  visited_ = 0;
  hash_boxes(boxes, settings);
  pairs_in_buckets(boxes, settings, out);
  pairs_of_oversize(boxes, settings.own, out);
}

template <typename T>
void BoxPairFinderOf<T>::hash_boxes(const Boxes& boxes, const BoxPairSettings& settings) {
  const T cell_size = static_cast<T>(settings.cell_size);
  hash_.clear(settings.table_size);
  oversize_.clear();
  is_oversize_.assign(boxes.size(), 0);
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    const AabbOf<T>& box = boxes[i].box;
    const GridKey lo = grid_key<T>(box.lo, cell_size);
    const GridKey hi = grid_key<T>(box.hi, cell_size);
    if (buckets_met(lo, hi) > settings.largest_buckets_per_box) {
      oversize_.push_back(i);
      is_oversize_[i] = 1;
      continue;
    }
    for (std::int64_t z = lo.z; z <= hi.z; ++z)
      for (std::int64_t y = lo.y; y <= hi.y; ++y)
        for (std::int64_t x = lo.x; x <= hi.x; ++x) hash_.insert({x, y, z}, i);
  }
  hash_.build();
}

template <typename T>
void BoxPairFinderOf<T>::pairs_in_buckets(const Boxes& boxes, const BoxPairSettings& settings,
                                          std::vector<Pair>& out) {
  const T cell_size = static_cast<T>(settings.cell_size);
  for (std::size_t b = 0; b < hash_.bucket_count(); ++b) {
    const auto entries = hash_.bucket_at(b);
    if (!entries.empty()) visited_ += entries.size() * (entries.size() - 1) / 2;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const OwnedBoxOf<T>& first = boxes[entries[i].id];
      for (std::size_t j = i + 1; j < entries.size(); ++j) {
        if (entries[i].key != entries[j].key) continue;
        const OwnedBoxOf<T>& second = boxes[entries[j].id];
        if ((first.body == second.body) != settings.own || !first.box.overlaps(second.box))
          continue;
        // floor is monotone: the key of the intersection's lower corner lies in both boxes' ranges.
        const Vec3Of<T> corner = first.box.lo.cwiseMax(second.box.lo);
        if (grid_key<T>(corner, cell_size) == entries[i].key)
          out.emplace_back(std::min(entries[i].id, entries[j].id),
                           std::max(entries[i].id, entries[j].id));
      }
    }
  }
}

template <typename T>
void BoxPairFinderOf<T>::pairs_of_oversize(const Boxes& boxes, bool own, std::vector<Pair>& out) {
  visited_ += oversize_.size() * boxes.size();
  for (std::uint32_t big : oversize_) {
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      if (is_oversize_[i] && i <= big) continue;  // two oversize boxes meet once
      if ((boxes[i].body == boxes[big].body) != own || !boxes[i].box.overlaps(boxes[big].box))
        continue;
      out.emplace_back(std::min(i, big), std::max(i, big));
    }
  }
}

template class BoxPairFinderOf<double>;
template class BoxPairFinderOf<float>;

}  // namespace contactcheck
