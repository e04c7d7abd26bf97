#include "reference/oracle/surface_tree.h"

#include <algorithm>
#include <numeric>

#include "core/types/check.h"

namespace contactcheck::oracle {
namespace {

// Triangles per leaf. Fewer: more nodes to refit; more: more triangle boxes to compare per leaf.
constexpr std::uint32_t kLeafSize = 4;

std::vector<Vec3> centroids_of(const TriangleMesh& mesh) {
  std::vector<Vec3> out;
  out.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    // Thirds first: the sum of three large coordinates could overflow.
    out.push_back(mesh.vertices[t[0]] / 3 + mesh.vertices[t[1]] / 3 + mesh.vertices[t[2]] / 3);
  }
  return out;
}

int longest_axis(const Aabb& box) {
  const Vec3 extent = 0.5 * box.hi - 0.5 * box.lo;
  int axis = 0;
  extent.maxCoeff(&axis);
  return axis;
}

}  // namespace

SurfaceTree::SurfaceTree(const TriangleMesh& rest)
    : triangles_(rest.triangles), order_(rest.triangles.size()), boxes_(rest.triangles.size()) {
  CONTACTCHECK_INVARIANT(!triangles_.empty(), "a surface has triangles");
  std::iota(order_.begin(), order_.end(), 0u);
  build(0, static_cast<std::uint32_t>(order_.size()), centroids_of(rest));
}

std::uint32_t SurfaceTree::build(std::uint32_t first, std::uint32_t last,
                                 const std::vector<Vec3>& centroids) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  if (last - first <= kLeafSize) {
    nodes_[index].first = first;
    nodes_[index].count = last - first;
    return index;
  }
  Aabb box;
  for (std::uint32_t i = first; i < last; ++i) box.extend(centroids[order_[i]]);
  const int axis = longest_axis(box);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(centroids[a][axis], a) < std::pair(centroids[b][axis], b);
                   });
  build(first, middle, centroids);
  const std::uint32_t second = build(middle, last, centroids);
  nodes_[index].second = second;
  return index;
}

void SurfaceTree::refit(std::span<const Vec3> start, std::span<const Vec3> end) {
  const bool moves = start.data() != end.data();
  vertices_ = start;
  for (std::size_t place = 0; place < order_.size(); ++place) {
    Aabb box;
    for (std::uint32_t v : triangles_[order_[place]]) {
      box.extend(start[v]);
      if (moves) box.extend(end[v]);
    }
    boxes_[place] = box;
  }
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    if (node.is_leaf()) {
      node.box = Aabb();
      for (std::uint32_t k = 0; k < node.count; ++k) node.box.extend(boxes_[node.first + k]);
    } else {
      node.box = nodes_[i + 1].box;
      node.box.extend(nodes_[node.second].box);
    }
  }
}

bool SurfaceTree::validate() const {
  std::vector<bool> seen(order_.size(), false);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (!node.is_leaf()) {
      if (!node.box.contains(nodes_[i + 1].box)) return false;
      if (!node.box.contains(nodes_[node.second].box)) return false;
    }
    for (std::uint32_t place = node.first; place < node.first + node.count; ++place) {
      if (seen[order_[place]]) return false;
      seen[order_[place]] = true;
      for (const Vec3& p : corners(order_[place]))
        if (!node.box.contains(p) || !boxes_[place].contains(p)) return false;
    }
  }
  return std::find(seen.begin(), seen.end(), false) == seen.end();
}

}  // namespace contactcheck::oracle
