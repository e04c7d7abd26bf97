#include "core/lazy/lattice_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "core/lazy/partition.h"
#include "core/types/check.h"
#include "core/types/count.h"
#include "core/types/mesh_topology.h"

namespace contactcheck {
namespace {

// What a mesh may have at most is what the narrow numbers of a tree hold
// (core/types/mesh_topology.h).
static_assert(3 * kMostMeshTriangles <= kMostNumbered, "vertices and runs of leaves, with repeats");
static_assert(kMostMeshTriangles <= TreeChild::kLeaf, "leaves");
static_assert(kMostMeshTriangles * kBlockWidth <= kMostNumbered + 1, "children of blocks");
static_assert(3 * kLeafTriangles <= 256, "vertices of a leaf, in LeafCorners");

// A piece of a child: what it has in one home cell.
struct Piece {
  std::uint32_t child = 0, cell = 0;
  std::uint32_t vertices = 0;  // number of triangle corners in it
  Aabb box;                    // bounds of y = 2 x - 1
  double slab_lo = std::numeric_limits<double>::infinity(), slab_hi = -slab_lo;
};

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
    if (bounded_) add_pieces(part, block);
    for (std::uint32_t c = 0; c < block.children; ++c) {
      const Part& child = part.children[c];
      block.child[c].value =
          child.children.empty() ? TreeChild::kLeaf | add_leaf(child) : add_block(child);
    }
    out_.blocks[index] = block;
    return index;
  }

 private:
  std::span<const std::uint32_t> triangles(const Part& part) const {
    return std::span(partition_.order).subspan(part.first, part.last - part.first);
  }
  const Triangle& corners(std::uint32_t triangle) const { return shape_.mesh.triangles[triangle]; }

  void add_pieces(const Part& part, TreeBlock& block) {
    BlockSlabs slabs;
    std::vector<Piece> first, others;
    for (std::uint32_t c = 0; c < part.children.size(); ++c) {
      std::vector<Piece> pieces = pieces_of(part.children[c], c);
      const auto most =
          std::max_element(pieces.begin(), pieces.end(),
                           [](const Piece& a, const Piece& b) { return a.vertices < b.vertices; });
      std::iter_swap(pieces.begin(), most);
      set_slabs(part.children[c], pieces, slabs);
      first.push_back(pieces[0]);
      others.insert(others.end(), pieces.begin() + 1, pieces.end());
    }
    out_.slabs.push_back(slabs);
    block.begin = in_32_bits<RefusedInput>(out_.pieces.size(), "pieces of blocks");
    put_lanes(first);
    for (std::size_t i = 0; i < others.size(); i += kBlockWidth)
      put_lanes(
          std::span(others).subspan(i, std::min<std::size_t>(kBlockWidth, others.size() - i)));
    block.end = in_32_bits<RefusedInput>(out_.pieces.size(), "pieces of blocks");
  }

  template <typename Visit>
  void for_corners(const Part& child, Visit&& visit) const {
    for (std::uint32_t t : triangles(child))
      for (std::uint32_t v : corners(t)) visit(shape_.embedding.home_cell[v], centred(v));
  }
  // Rounds by 2^-54 at most.
  Vec3 centred(std::uint32_t vertex) const {
    return 2.0 * shape_.embedding.local[vertex] - Vec3::Ones();
  }

  std::vector<Piece> pieces_of(const Part& child, std::uint32_t lane) const {
    std::map<std::uint32_t, Piece> pieces;
    for_corners(child, [&](std::uint32_t cell, const Vec3& y) {
      Piece& piece = pieces[cell];
      piece.child = lane, piece.cell = cell;
      piece.box.extend(y);
      ++piece.vertices;
    });
    std::vector<Piece> out;
    for (const auto& [cell, piece] : pieces) out.push_back(piece);
    return out;
  }

  // Across the child's surface at rest, in the cell of its first piece.
  void set_slabs(const Part& child, std::vector<Piece>& pieces, BlockSlabs& slabs) const {
    const Eigen::Array3i normal =
        normal_of(child, shape_.lattice->cell_box(pieces[0].cell).extent());
    for (int k = 0; k < 3; ++k)
      slabs.normal[k][pieces[0].child] = static_cast<std::int8_t>(normal[k]);
    const Vec3 m = normal.cast<double>().matrix();
    for_corners(child, [&](std::uint32_t cell, const Vec3& y) {
      Piece& piece = *std::find_if(pieces.begin(), pieces.end(),
                                   [&](const Piece& p) { return p.cell == cell; });
      piece.slab_lo = std::min(piece.slab_lo, m.dot(y));
      piece.slab_hi = std::max(piece.slab_hi, m.dot(y));
    });
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
    // Checks all components: maxCoeff() is unspecified if one of them is NaN.
    const double largest = normal.cwiseAbs().maxCoeff();
    if (!normal.allFinite() || !(largest > 0.0)) return {1, 0, 0};
    return (normal / largest * BlockSlabs::kNormalSteps).array().round().cast<int>();
  }

  void put_lanes(std::span<const Piece> pieces) {
    PieceLanes& out = out_.pieces.emplace_back();
    for (std::size_t lane = 0; lane < kBlockWidth; ++lane)
      put_lane(pieces[lane < pieces.size() ? lane : 0], lane, out);
  }

  // The margin covers the rounding of y and of m.y, which is at most 381 and rounds by less than
  // 2^-42.
  static void put_lane(const Piece& piece, std::size_t lane, PieceLanes& out) {
    constexpr double kMargin = 0x1p-40;
    out.cell[lane] = piece.cell;
    out.child[lane] = static_cast<std::uint8_t>(piece.child);
    for (int k = 0; k < 3; ++k) {
      const double lo = (piece.box.lo[k] - kMargin) * PieceLanes::kSteps;
      const double hi = (piece.box.hi[k] + kMargin) * PieceLanes::kSteps;
      out.lo[k][lane] = static_cast<std::int16_t>(std::floor(lo));
      out.hi[k][lane] = static_cast<std::int16_t>(std::ceil(hi));
    }
    out.slab_lo[lane] = std::nextafter(static_cast<float>(piece.slab_lo - kMargin), -1e9f);
    out.slab_hi[lane] = std::nextafter(static_cast<float>(piece.slab_hi + kMargin), 1e9f);
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

template <typename T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

void round_local(const BodyShape& shape, TreeUse use, LatticeTree& tree) {
  if (use == TreeUse::kVertices) {
    tree.single_sorted_local = single_local(shape.embedding);
  } else {
    for (int k = 0; k < 3; ++k)
      tree.single_leaf_local[k].assign(tree.leaf_local[k].begin(), tree.leaf_local[k].end());
  }
  tree.leaf_local = {};
}

}  // namespace

std::size_t LatticeTree::bytes() const {
  std::size_t local = 0;
  for (int k = 0; k < 3; ++k)
    local +=
        bytes_of(leaf_local[k]) + bytes_of(single_leaf_local[k]) + bytes_of(single_sorted_local[k]);
  return bytes_of(blocks) + bytes_of(pieces) + bytes_of(slabs) + bytes_of(leaves) +
         bytes_of(leaf_triangles) + bytes_of(leaf_corners) + bytes_of(leaf_vertices) + local +
         bytes_of(runs);
}

LatticeTree make_lattice_tree(const BodyShape& shape, TreeUse use, Precision precision) {
  CONTACTCHECK_INVARIANT(!shape.mesh.triangles.empty(), "a tree of something");
  LatticeTree tree;
  const Partition partition = partition_triangles(shape);
  TreeBuilder(shape, partition, use, tree).add_block(partition.root);
  tree.leaf_vertices.resize(tree.leaf_vertices.size() + kLeafPadding, 0);
  if (!shape.lattice) return tree;
  for (auto& axis : tree.leaf_local) axis.resize(axis.size() + kLeafPadding, 0.0);
  if (precision == Precision::kSingle) round_local(shape, use, tree);
  return tree;
}

}  // namespace contactcheck
