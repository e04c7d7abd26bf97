#include "core/lazy/lattice_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>

#include "core/lazy/partition.h"
#include "core/types/check.h"

namespace contactcheck {
namespace {

// Blocks of more home cells than this are bounded by hulls: each home cell costs one evaluation
// for all eight children, however few of them it touches. But hulls are as loose as whole cells
// are large, and let through what costs more below: by measurement, a near miss of two fine meshes
// takes three times as long with 8, and one of small meshes 1.7 times as long with no hulls at all.
constexpr std::size_t kMostHomes = 32;

using LocalBounds = std::map<std::uint32_t, Aabb>;  // per home cell

class TreeBuilder {
 public:
  TreeBuilder(const BodyShape& shape, const Partition& partition, TreeUse use, LatticeTree& out)
      : shape_(shape),
        partition_(partition),
        bounded_(shape.lattice && use == TreeUse::kNodes),
        out_(out) {}

  std::uint32_t add_block(const Part& part) {
    const auto index = static_cast<std::uint32_t>(out_.blocks.size());
    out_.blocks.emplace_back();
    TreeBlock block;
    block.children = static_cast<std::uint32_t>(part.children.size());
    if (bounded_) bound_children(part, block);
    for (std::uint32_t c = 0; c < block.children; ++c) {
      const Part& child = part.children[c];
      // A hull is as large as its cells: a leaf gets a block of its own, bounded by pieces, so that
      // it does not meet whatever comes near its cells.
      block.child[c].value = !child.children.empty() ? add_block(child)
                             : block.hull            ? add_block({child.first, child.last, {child}})
                                                     : (TreeChild::kLeaf | add_leaf(child));
    }
    out_.blocks[index] = block;
    return index;
  }

 private:
  std::span<const std::uint32_t> triangles(const Part& part) const {
    return std::span(partition_.order).subspan(part.first, part.last - part.first);
  }
  const Triangle& corners(std::uint32_t triangle) const { return shape_.mesh.triangles[triangle]; }

  LocalBounds local_bounds(const Part& part) const {
    LocalBounds bounds;
    for (std::uint32_t t : triangles(part))
      for (std::uint32_t v : corners(t))
        bounds[shape_.embedding.home_cell[v]].extend(shape_.embedding.local[v]);
    return bounds;
  }

  std::set<std::uint32_t> owners(const Part& part) const {
    std::set<std::uint32_t> cells;
    for (std::uint32_t t : triangles(part)) cells.insert(partition_.owner[t]);
    return cells;
  }

  void bound_children(const Part& part, TreeBlock& block) {
    std::vector<LocalBounds> bounds;
    std::set<std::uint32_t> homes;
    for (const Part& child : part.children) {
      bounds.push_back(local_bounds(child));
      for (const auto& [cell, box] : bounds.back()) homes.insert(cell);
    }
    block.hull = homes.size() > kMostHomes && part.children.size() > 1 && owners(part).size() > 1;
    block.begin = static_cast<std::uint32_t>(block.hull ? out_.hulls.size() : out_.pieces.size());
    if (block.hull) {
      for (const Part& child : part.children) add_hull(child);
    } else {
      block.slabs = static_cast<std::uint32_t>(out_.slabs.size());
      const std::uint32_t main = most_common_home(part);
      out_.slabs.push_back(slabs_of(part, main));
      add_pieces(main, bounds, part, out_.slabs.back());
      for (std::uint32_t cell : homes)
        if (cell != main) add_pieces(cell, bounds, part, out_.slabs.back());
    }
    block.end = static_cast<std::uint32_t>(block.hull ? out_.hulls.size() : out_.pieces.size());
  }

  std::uint32_t most_common_home(const Part& part) const {
    std::map<std::uint32_t, std::uint32_t> counts;
    for (std::uint32_t t : triangles(part))
      for (std::uint32_t v : corners(t)) ++counts[shape_.embedding.home_cell[v]];
    const auto most =
        std::max_element(counts.begin(), counts.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return most->first;
  }

  Vec3 rest(std::uint32_t vertex) const { return shape_.mesh.vertices[vertex]; }

  // The mean normal at rest, in steps: a covector of local coordinates grows with the cell's sides.
  Eigen::Array3i normal_of(const Part& child, const Vec3& sides) const {
    Vec3 sum = Vec3::Zero();
    for (std::uint32_t t : triangles(child)) {
      const auto& [a, b, c] = corners(t);
      sum += (rest(b) - rest(a)).cross(rest(c) - rest(a));
    }
    const Vec3 normal = sum.cwiseProduct(sides);
    const double largest = normal.cwiseAbs().maxCoeff();
    if (!(largest > 0.0) || !std::isfinite(largest)) return {1, 0, 0};
    return (normal / largest * BlockSlabs::kNormalSteps).array().round().cast<int>();
  }

  BlockSlabs slabs_of(const Part& part, std::uint32_t cell) const {
    BlockSlabs out;
    const Vec3 sides = shape_.lattice->cell_box(cell).extent();
    for (std::uint32_t c = 0; c < part.children.size(); ++c) {
      const Eigen::Array3i normal = normal_of(part.children[c], sides);
      for (int k = 0; k < 3; ++k) out.normal[k][c] = static_cast<std::int8_t>(normal[k]);
    }
    return out;
  }

  void add_pieces(std::uint32_t cell, const std::vector<LocalBounds>& bounds, const Part& part,
                  const BlockSlabs& slabs) {
    HomePieces pieces;
    pieces.cell = cell;
    for (std::uint32_t c = 0; c < bounds.size(); ++c) {
      const auto found = bounds[c].find(cell);
      if (found == bounds[c].end()) continue;
      pieces.children |= 1u << c;
      for (int k = 0; k < 3; ++k) {
        pieces.lo[k][c] =
            static_cast<std::uint16_t>(std::floor(found->second.lo[k] * HomePieces::kSteps));
        pieces.hi[k][c] =
            static_cast<std::uint16_t>(std::ceil(found->second.hi[k] * HomePieces::kSteps));
      }
      bound_slab(part.children[c], c, slabs, pieces);
    }
    out_.pieces.push_back(pieces);
  }

  // m.x of at most 381 rounds by less than 2^-43, far below a step of a float there; where it
  // cancels to nearly 0 the fixed margin covers it.
  void bound_slab(const Part& child, std::uint32_t c, const BlockSlabs& slabs,
                  HomePieces& pieces) const {
    constexpr float kMargin = 0x1p-40f;
    double lo = std::numeric_limits<double>::infinity(), hi = -lo;
    for (std::uint32_t t : triangles(child))
      for (std::uint32_t v : corners(t)) {
        if (shape_.embedding.home_cell[v] != pieces.cell) continue;
        const Vec3& x = shape_.embedding.local[v];
        const double along =
            slabs.normal[0][c] * x.x() + slabs.normal[1][c] * x.y() + slabs.normal[2][c] * x.z();
        lo = std::min(lo, along);
        hi = std::max(hi, along);
      }
    pieces.slab_lo[c] = std::nextafter(static_cast<float>(lo) - kMargin, -1e9f);
    pieces.slab_hi[c] = std::nextafter(static_cast<float>(hi) + kMargin, 1e9f);
  }

  void add_hull(const Part& child) {
    HullChild hull;
    const std::set<std::uint32_t> own = owners(child);
    std::set<std::uint32_t> nodes;
    for (std::uint32_t cell : own) add_nodes(cell, nodes);
    for (std::uint32_t t : triangles(child))
      for (std::uint32_t v : corners(t))
        if (!own.count(shape_.embedding.home_cell[v])) add_way(partition_.owner[t], v, hull, nodes);
    hull.node_begin = static_cast<std::uint32_t>(out_.hull_nodes.size());
    out_.hull_nodes.insert(out_.hull_nodes.end(), nodes.begin(), nodes.end());
    hull.node_end = static_cast<std::uint32_t>(out_.hull_nodes.size());
    out_.hulls.push_back(hull);
  }

  void add_nodes(std::uint32_t cell, std::set<std::uint32_t>& nodes) const {
    const CornerIds& ids = shape_.lattice->cell_nodes[cell];
    nodes.insert(ids.begin(), ids.end());
  }

  void add_way(std::uint32_t owner, std::uint32_t vertex, HullChild& hull,
               std::set<std::uint32_t>& nodes) const {
    const std::uint32_t home = shape_.embedding.home_cell[vertex];
    const GridIndex &from = shape_.lattice->cells[home], &to = shape_.lattice->cells[owner];
    const auto step = [&](int k) { return static_cast<std::int64_t>(from[k]) - to[k]; };
    for (int k = 0; k < 3; ++k)
      if (step(k) < -1 || step(k) > 1) return add_nodes(home, nodes);
    for (int k = 0; k < 3; ++k) {
      if (step(k) == 0) continue;
      const double x = shape_.embedding.local[vertex][k];
      // Outward: 1 - x rounds, the conversion to float too.
      const auto way = std::nextafter(static_cast<float>(step(k) > 0 ? x : 1.0 - x), 2.0f);
      hull.reach[k] = std::max(hull.reach[k], std::min(1.0f, way));
    }
  }

  std::uint32_t add_leaf(const Part& part) {
    TreeLeaf leaf;
    leaf.first_triangle = static_cast<std::uint32_t>(out_.leaf_triangles.size());
    leaf.first_vertex = static_cast<std::uint32_t>(out_.leaf_vertices.size());
    leaf.first_run = static_cast<std::uint32_t>(out_.runs.size());
    const std::vector<std::uint32_t> vertices = leaf_vertices(part);
    for (std::uint32_t v : vertices) add_vertex(v, leaf);
    LeafCorners ids{};
    for (std::uint32_t i = 0; i < part.last - part.first; ++i) {
      const std::uint32_t t = triangles(part)[i];
      for (int k = 0; k < 3; ++k)
        ids[k][i] = static_cast<std::uint8_t>(
            std::find(vertices.begin(), vertices.end(), corners(t)[k]) - vertices.begin());
      out_.leaf_triangles.push_back(t);
    }
    out_.leaf_corners.push_back(ids);
    leaf.triangles = static_cast<std::uint16_t>(part.last - part.first);
    leaf.vertices = static_cast<std::uint16_t>(vertices.size());
    out_.leaves.push_back(leaf);
    return static_cast<std::uint32_t>(out_.leaves.size() - 1);
  }

  // Distinct, by home cell.
  std::vector<std::uint32_t> leaf_vertices(const Part& part) const {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t t : triangles(part))
      vertices.insert(vertices.end(), corners(t).begin(), corners(t).end());
    const auto key = [&](std::uint32_t v) {
      return std::pair(shape_.lattice ? shape_.embedding.home_cell[v] : 0, v);
    };
    std::sort(vertices.begin(), vertices.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  void add_vertex(std::uint32_t v, TreeLeaf& leaf) {
    out_.leaf_vertices.push_back(v);
    if (!shape_.lattice) return;
    const std::uint32_t cell = shape_.embedding.home_cell[v];
    if (leaf.runs == 0 || out_.runs.back().cell != cell) {
      out_.runs.push_back({cell, 0});
      ++leaf.runs;
    }
    ++out_.runs.back().count;
    for (int k = 0; k < 3; ++k) out_.leaf_local[k].push_back(shape_.embedding.local[v][k]);
  }

  const BodyShape& shape_;
  const Partition& partition_;
  const bool bounded_;
  LatticeTree& out_;
};

std::array<std::vector<LatticeEdge>, 3> edges_of(const Lattice& lattice) {
  std::array<std::vector<LatticeEdge>, 3> out;
  for (int k = 0; k < 3; ++k) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> known;
    for (const CornerIds& ids : lattice.cell_nodes)
      for (int c = 0; c < 8; ++c)
        if ((c >> k & 1) == 0) known.insert({ids[c], ids[c | 1 << k]});
    for (const auto& [from, to] : known) out[k].push_back({from, to});
  }
  return out;
}

template <typename T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

std::size_t LatticeTree::bytes() const {
  std::size_t local = 0;
  for (const auto& axis : leaf_local) local += bytes_of(axis);
  for (const auto& axis : edges) local += bytes_of(axis);
  return bytes_of(blocks) + bytes_of(pieces) + bytes_of(slabs) + bytes_of(hulls) +
         bytes_of(hull_nodes) + bytes_of(leaves) + bytes_of(leaf_triangles) +
         bytes_of(leaf_corners) + bytes_of(leaf_vertices) + local + bytes_of(runs);
}

LatticeTree make_lattice_tree(const BodyShape& shape, TreeUse use) {
  CONTACTCHECK_INVARIANT(!shape.mesh.triangles.empty(), "a tree of something");
  LatticeTree tree;
  const Partition partition = partition_triangles(shape);
  TreeBuilder(shape, partition, use, tree).add_block(partition.root);
  tree.leaf_vertices.resize(tree.leaf_vertices.size() + kLeafPadding, 0);
  if (!shape.lattice) return tree;
  tree.edges = edges_of(*shape.lattice);
  for (auto& axis : tree.leaf_local) axis.resize(axis.size() + kLeafPadding, 0.0);
  return tree;
}

}  // namespace contactcheck
