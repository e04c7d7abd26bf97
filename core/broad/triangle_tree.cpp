#include "core/broad/triangle_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/types/check.h"

namespace contactcheck {
namespace {

constexpr int kBins = 16;

struct Range {
  std::uint32_t node = 0, begin = 0, end = 0, depth = 0;
  std::uint32_t size() const { return end - begin; }
};

/// One side of a split. What a query pays for it is taken to grow with surface times triangles.
struct Part {
  Aabb box;
  std::uint32_t count = 0;

  void add(const Aabb& other, std::uint32_t triangles) {
    box.extend(other);
    count += triangles;
  }
  double cost() const {
    if (count == 0) return 0.0;  // an empty box has no area
    const Vec3 e = box.extent();
    return (e.x() * e.y() + e.y() * e.z() + e.z() * e.x()) * count;
  }
};

class Builder {
 public:
  Builder(const TriangleMesh& mesh, std::uint32_t leaf_size) : mesh_(mesh), leaf_size_(leaf_size) {
    for (const Triangle& t : mesh.triangles) {
      Aabb box;
      for (std::uint32_t v : t) box.extend(mesh.vertices[v]);
      boxes_.push_back(box);
      centers_.push_back(box.center());
    }
    order_.resize(mesh.triangles.size());
    std::iota(order_.begin(), order_.end(), 0u);
    // Splits after which every further one is in halves; log2(n) more of those reach the leaves.
    depth_limit_ = static_cast<std::uint32_t>(std::bit_width(order_.size())) + 16;
  }

  TriangleTree build() {
    TriangleTree tree;
    tree.nodes.resize(1);
    std::vector<Range> open = {{0, 0, static_cast<std::uint32_t>(order_.size()), 0}};
    while (!open.empty()) {
      const Range range = open.back();
      open.pop_back();
      if (range.size() <= leaf_size_) {
        tree.nodes[range.node] = {range.begin, range.size()};
        continue;
      }
      const std::uint32_t middle = split(range);
      const auto child = static_cast<std::uint32_t>(tree.nodes.size());
      tree.nodes[range.node] = {child, 0};
      tree.nodes.resize(child + 2);
      // The left child is next: neighbours in the tree are neighbours in memory.
      open.push_back({child + 1, middle, range.end, range.depth + 1});
      open.push_back({child, range.begin, middle, range.depth + 1});
    }
    for (std::uint32_t t : order_) tree.corners.push_back(mesh_.triangles[t]);
    tree.ids = std::move(order_);
    return tree;
  }

 private:
  struct Plane {
    int axis = 0, bin = 0;  // triangles of this bin and those below go left
    double cost = std::numeric_limits<double>::infinity();
  };

  /// Orders the range into two parts and returns where the second begins; neither is empty.
  std::uint32_t split(const Range& range) {
    Aabb centers;
    for (std::uint32_t i = range.begin; i < range.end; ++i) centers.extend(centers_[order_[i]]);
    Plane best;
    for (int axis = 0; axis < 3 && range.depth < depth_limit_; ++axis)
      find_plane(range, centers, axis, best);
    // Also false where areas overflowed or vanished: an infinite or zero cost chooses nothing.
    if (best.cost > 0.0 && std::isfinite(best.cost)) return split_at(range, centers, best);
    return split_in_halves(range, centers);
  }

  int bin_of(std::uint32_t triangle, const Aabb& centers, int axis) const {
    const double extent = centers.hi[axis] - centers.lo[axis];
    const double share = (centers_[triangle][axis] - centers.lo[axis]) / extent;
    return std::min(kBins - 1, static_cast<int>(share * kBins));
  }

  struct Bins {
    std::array<Aabb, kBins> boxes;
    std::array<std::uint32_t, kBins> counts = {};
  };

  Bins fill_bins(const Range& range, const Aabb& centers, int axis) const {
    Bins bins;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const int bin = bin_of(order_[i], centers, axis);
      bins.boxes[bin].extend(boxes_[order_[i]]);
      ++bins.counts[bin];
    }
    return bins;
  }

  void find_plane(const Range& range, const Aabb& centers, int axis, Plane& best) const {
    const double extent = centers.hi[axis] - centers.lo[axis];
    if (!(extent > 0.0) || !std::isfinite(extent)) return;
    const Bins bins = fill_bins(range, centers, axis);
    std::array<double, kBins> cost_behind = {};  // cost of the bins after this one
    Part behind, before;
    for (int bin = kBins - 1; bin > 0; --bin) {
      behind.add(bins.boxes[bin], bins.counts[bin]);
      cost_behind[bin - 1] = behind.cost();
    }
    for (int bin = 0; bin + 1 < kBins; ++bin) {
      before.add(bins.boxes[bin], bins.counts[bin]);
      if (before.count == 0 || before.count == range.size()) continue;
      const double cost = before.cost() + cost_behind[bin];
      if (cost < best.cost) best = {axis, bin, cost};
    }
  }

  std::uint32_t split_at(const Range& range, const Aabb& centers, const Plane& plane) {
    const auto begin = order_.begin() + range.begin, end = order_.begin() + range.end;
    const auto middle = std::stable_partition(
        begin, end, [&](std::uint32_t t) { return bin_of(t, centers, plane.axis) <= plane.bin; });
    return static_cast<std::uint32_t>(middle - order_.begin());
  }

  std::uint32_t split_in_halves(const Range& range, const Aabb& centers) {
    int axis = 0;
    const Vec3 extent = centers.extent();
    extent.maxCoeff(&axis);
    const std::uint32_t middle = range.begin + range.size() / 2;
    // Sorted, and not only partitioned: then no freedom of the library shows in the tree.
    std::sort(order_.begin() + range.begin, order_.begin() + range.end,
              [&](std::uint32_t s, std::uint32_t t) {
                if (centers_[s][axis] != centers_[t][axis])
                  return centers_[s][axis] < centers_[t][axis];
                return s < t;
              });
    return middle;
  }

  const TriangleMesh& mesh_;
  std::uint32_t leaf_size_, depth_limit_ = 0;
  std::vector<Aabb> boxes_;  // per triangle, at rest
  std::vector<Vec3> centers_;
  std::vector<std::uint32_t> order_;
};

std::string slot_fault(const TriangleTree& tree, const TriangleMesh& mesh) {
  std::vector<int> uses(mesh.triangles.size(), 0);
  if (tree.ids.size() != uses.size() || tree.corners.size() != uses.size())
    return "not one slot per triangle";
  for (std::size_t s = 0; s < tree.ids.size(); ++s) {
    if (tree.ids[s] >= uses.size()) return "slot " + std::to_string(s) + " holds no triangle";
    if (uses[tree.ids[s]]++ > 0) return "slot " + std::to_string(s) + " holds a triangle again";
    if (tree.corners[s] != mesh.triangles[tree.ids[s]])
      return "slot " + std::to_string(s) + " has other corners than its triangle";
  }
  return "";
}

}  // namespace

std::string TriangleTree::validate(const TriangleMesh& mesh) const {
  std::vector<int> parents(nodes.size(), 0), leaves(ids.size(), 0);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Node& node = nodes[n];
    const std::string name = "node " + std::to_string(n);
    const std::size_t end = std::size_t{node.first} + (node.leaf() ? node.count : 2);
    if (!node.leaf() && node.first <= n) return name + " has a child before itself";
    if (end > (node.leaf() ? ids.size() : nodes.size())) return name + " points behind the end";
    for (std::size_t i = node.first; i < end; ++i) ++(node.leaf() ? leaves : parents)[i];
  }
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (parents[n] != (n > 0)) return "node " + std::to_string(n) + " is not the child of one";
  for (std::size_t s = 0; s < ids.size(); ++s)
    if (leaves[s] != 1) return "slot " + std::to_string(s) + " is not in one leaf";
  return slot_fault(*this, mesh);
}

TriangleTree make_triangle_tree(const TriangleMesh& mesh, std::uint32_t leaf_size) {
  CONTACTCHECK_INVARIANT(leaf_size >= 1 && !mesh.triangles.empty(), "there is something to hold");
  return Builder(mesh, leaf_size).build();
}

std::vector<std::shared_ptr<const TriangleTree>> make_triangle_trees(
    const std::vector<Body>& bodies, std::uint32_t leaf_size) {
  std::map<const BodyShape*, std::shared_ptr<const TriangleTree>> made;
  std::vector<std::shared_ptr<const TriangleTree>> trees;
  for (const Body& body : bodies) {
    std::shared_ptr<const TriangleTree>& tree = made[body.shape.get()];
    if (!tree)
      tree = std::make_shared<TriangleTree>(make_triangle_tree(body.shape->mesh, leaf_size));
    trees.push_back(tree);
  }
  return trees;
}

}  // namespace contactcheck
