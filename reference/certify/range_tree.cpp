#include "reference/certify/range_tree.h"

#include "reference/oracle/surface_tree.h"

namespace contactcheck::certify {

RangeTree::RangeTree(const TriangleMesh& rest)
    : triangles_(rest.triangles), boxes_(2 * rest.triangles.size() - 1) {
  const oracle::SurfaceTree tree(rest);
  for (std::uint32_t place = 0; place < triangles_.size(); ++place)
    order_.push_back(tree.triangle_at(place));
}

void RangeTree::refit(std::span<const Vec3> vertices) { refit(all(), vertices); }

const Aabb& RangeTree::refit(const Range& range, std::span<const Vec3> vertices) {
  Aabb box;
  if (range.size() == 1) {
    for (std::uint32_t v : triangles_[order_[range.first]]) box.extend(vertices[v]);
  } else {
    box = refit(range.lower_half(), vertices);
    box.extend(refit(range.upper_half(), vertices));
  }
  return boxes_[range.node] = box;
}

}  // namespace contactcheck::certify
