#include "core/broad/body_pairs.h"

#include <algorithm>
#include <numeric>

namespace contactcheck {
namespace {

// The axis along which the boxes lie farthest apart, measured in box widths: the fewest overlap.
int sweep_axis(std::span<const Aabb> boxes) {
  Aabb centers;
  Vec3 widths = Vec3::Zero();
  for (const Aabb& box : boxes) {
    centers.extend(box.center());
    widths += box.extent();
  }
  int best = 0;
  for (int k = 1; k < 3; ++k)
    if (centers.extent()[k] * widths[best] > centers.extent()[best] * widths[k]) best = k;
  return best;
}

}  // namespace

void find_candidate_bodies(std::span<const Aabb> boxes, std::vector<BodyPair>& out) {
  out.clear();
  if (boxes.size() < 2) return;
  const int axis = sweep_axis(boxes);
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return boxes[a].lo[axis] < boxes[b].lo[axis];
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Aabb &first = boxes[order[i]], &second = boxes[order[j]];
      if (second.lo[axis] > first.hi[axis]) break;
      if (first.overlaps(second))
        out.push_back({std::min(order[i], order[j]), std::max(order[i], order[j])});
    }
  std::sort(out.begin(), out.end());
}

}  // namespace contactcheck
