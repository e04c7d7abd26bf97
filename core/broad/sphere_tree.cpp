#include "core/broad/sphere_tree.h"

#include <algorithm>
#include <limits>
#include <set>

namespace contactcheck {
namespace {

std::vector<std::uint32_t> nodes_of(const Lattice& lattice, std::span<const std::uint32_t> cells) {
  std::set<std::uint32_t> nodes;
  for (std::uint32_t cell : cells)
    nodes.insert(lattice.cell_nodes[cell].begin(), lattice.cell_nodes[cell].end());
  return {nodes.begin(), nodes.end()};
}

Vec3 mean_center(const Lattice& lattice, std::span<const std::uint32_t> cells) {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t cell : cells) sum += lattice.cell_box(cell).center();
  return sum / static_cast<double>(std::max<std::size_t>(1, cells.size()));
}

// Farthest-point sampling over the nodes of the cells, starting at the node nearest the middle.
std::vector<std::uint32_t> spread_nodes(const Lattice& lattice,
                                        std::span<const std::uint32_t> cells, int count) {
  const std::vector<std::uint32_t> nodes = nodes_of(lattice, cells);
  const Vec3 middle = mean_center(lattice, cells);
  const auto nearer = [&](std::uint32_t a, std::uint32_t b) {
    return (lattice.rest_node(a) - middle).squaredNorm() <
           (lattice.rest_node(b) - middle).squaredNorm();
  };
  std::vector<std::uint32_t> chosen = {*std::min_element(nodes.begin(), nodes.end(), nearer)};
  std::vector<double> gap(nodes.size(), std::numeric_limits<double>::infinity());
  const std::size_t wanted = std::min<std::size_t>(count, cells.size());
  while (chosen.size() < wanted) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Vec3 d = lattice.rest_node(nodes[i]) - lattice.rest_node(chosen.back());
      gap[i] = std::min(gap[i], d.squaredNorm());
    }
    const auto farthest = std::max_element(gap.begin(), gap.end());
    if (*farthest == 0.0) break;
    chosen.push_back(nodes[farthest - gap.begin()]);
  }
  return chosen;
}

std::size_t nearest(const Lattice& lattice, std::span<const std::uint32_t> centers, const Vec3& p) {
  std::size_t best = 0;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const double d = (lattice.rest_node(centers[i]) - p).squaredNorm();
    if (d < best_distance) {
      best_distance = d;
      best = i;
    }
  }
  return best;
}

void split(const Lattice& lattice, const SphereNode& sphere, std::uint32_t number, int children,
           std::vector<SphereNode>& out) {
  if (sphere.cells.empty()) return;
  const std::vector<std::uint32_t> centers = spread_nodes(lattice, sphere.cells, children);
  std::vector<SphereNode> parts(centers.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].parent = number;
    parts[i].center_node = centers[i];
  }
  for (std::uint32_t cell : sphere.cells)
    parts[nearest(lattice, centers, lattice.cell_box(cell).center())].cells.push_back(cell);
  for (SphereNode& part : parts)
    if (!part.cells.empty()) out.push_back(std::move(part));
}

}  // namespace

SphereTree make_sphere_tree(const Lattice& lattice, std::span<const std::uint32_t> cells,
                            int levels, int children) {
  SphereTree tree;
  tree.levels.resize(levels);
  SphereNode top;
  top.cells.assign(cells.begin(), cells.end());
  tree.levels[0].push_back(std::move(top));
  for (int level = 1; level < levels; ++level) {
    for (std::uint32_t s = 0; s < tree.levels[level - 1].size(); ++s) {
      SphereNode& parent = tree.levels[level - 1][s];
      parent.child_begin = static_cast<std::uint32_t>(tree.levels[level].size());
      split(lattice, parent, s, children, tree.levels[level]);
      parent.child_end = static_cast<std::uint32_t>(tree.levels[level].size());
    }
  }
  return tree;
}

}  // namespace contactcheck
