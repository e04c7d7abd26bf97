// The tree at rest: what stands in it, once and in the right place.

#include "core/lazy/lattice_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>

#include "core/lazy/partition.h"
#include "tests/core/lazy/one_body.h"

namespace contactcheck {
namespace {

using test::ShapePtr;
using test::triangles_under;

struct NamedShape {
  std::string name;
  ShapePtr shape;
};

TriangleMesh first_triangles(TriangleMesh mesh, std::size_t count) {
  mesh.triangles.resize(count);
  return mesh;
}

const std::vector<NamedShape>& shapes() {
  static const std::vector<NamedShape> all = [] {
    const TriangleMesh ball = test::sphere_mesh(Vec3::Zero(), 1.0, 4);
    const TriangleMesh box = test::unit_box_mesh(12);
    return std::vector<NamedShape>{
        {"ball, one cell", make_shape(ball, {1, 1, 1})},
        {"ball, coarse", make_shape(ball, {4, 3, 4})},
        {"ball, fine", make_shape(ball, {16, 16, 16})},
        {"ball, bare", make_bare_shape(ball)},
        {"box, coarse", make_shape(box, {3, 4, 5})},
        {"box, on the planes between cells", test::box_on_its_nodes(8)},
        {"sheet", make_shape(test::sheet(20), {6, 6, 1})},
        {"long triangles", make_shape(test::long_triangles(3, 150), {7, 7, 7})},
        {"one triangle", make_shape(first_triangles(ball, 1), {2, 2, 2})},
        {"16 triangles", make_shape(first_triangles(ball, 16), {2, 2, 2})},
        {"17 triangles", make_shape(first_triangles(ball, 17), {2, 2, 2})},
        {"17 triangles, bare", make_bare_shape(first_triangles(ball, 17))},
    };
  }();
  return all;
}

template <typename Check>
void for_each_tree(Check&& check) {
  for (const NamedShape& named : shapes()) {
    SCOPED_TRACE(named.name);
    check(*named.shape, make_lattice_tree(*named.shape));
  }
}

// A leaf under a hull, bounded by pieces.
bool holds_one_leaf(const TreeBlock& block) {
  return block.children == 1 && block.child[0].leaf() && !block.hull;
}

TEST(LatticeTree, HoldsEveryTriangleInExactlyOneLeaf) {
  for_each_tree([](const BodyShape& shape, const LatticeTree& tree) {
    std::vector<int> found(shape.mesh.triangles.size(), 0);
    for (std::uint32_t t : triangles_under(tree, TreeChild{0})) ++found[t];
    EXPECT_EQ(std::count(found.begin(), found.end(), 1), std::ssize(found));
    EXPECT_EQ(tree.leaf_triangles.size(), found.size());
  });
}

TEST(LatticeTree, ReachesEveryBlockAndLeafFromOneParentOfLowerIndex) {
  for_each_tree([](const BodyShape&, const LatticeTree& tree) {
    std::vector<int> blocks(tree.blocks.size(), 0), leaves(tree.leaves.size(), 0);
    for (std::uint32_t b = 0; b < tree.blocks.size(); ++b) {
      EXPECT_GE(tree.blocks[b].children, b == 0 || holds_one_leaf(tree.blocks[b]) ? 1u : 2u);
      EXPECT_LE(tree.blocks[b].children, kBlockWidth);
      for (std::uint32_t c = 0; c < tree.blocks[b].children; ++c) {
        const TreeChild child = tree.blocks[b].child[c];
        ++(child.leaf() ? leaves : blocks).at(child.index());
        EXPECT_TRUE(child.leaf() || child.index() > b);
      }
    }
    EXPECT_EQ(blocks[0], 0);
    EXPECT_EQ(std::count(blocks.begin() + 1, blocks.end(), 1), std::ssize(blocks) - 1);
    EXPECT_EQ(std::count(leaves.begin(), leaves.end(), 1), std::ssize(leaves));
  });
}

TEST(LatticeTree, HasLeavesOfOneToSixteenTrianglesThatFollowOneAnother) {
  for_each_tree([](const BodyShape&, const LatticeTree& tree) {
    std::uint32_t triangles = 0, vertices = 0, runs = 0;
    for (const TreeLeaf& leaf : tree.leaves) {
      EXPECT_GE(leaf.triangles, 1u);
      EXPECT_LE(leaf.triangles, kLeafTriangles);
      EXPECT_EQ(leaf.first_triangle, triangles);
      EXPECT_EQ(leaf.first_vertex, vertices);
      EXPECT_EQ(leaf.first_run, runs);
      triangles += leaf.triangles, vertices += leaf.vertices, runs += leaf.runs;
    }
    EXPECT_EQ(tree.leaf_vertices.size(), vertices + kLeafPadding);
    EXPECT_EQ(tree.runs.size(), runs);
  });
}

TEST(LatticeTree, NamesTheCornersOfItsTriangles) {
  for_each_tree([](const BodyShape& shape, const LatticeTree& tree) {
    ASSERT_EQ(tree.leaf_corners.size(), tree.leaves.size());
    for (std::size_t l = 0; l < tree.leaves.size(); ++l)
      for (std::uint32_t i = 0; i < tree.leaves[l].triangles; ++i)
        for (int k = 0; k < 3; ++k) {
          const TreeLeaf& leaf = tree.leaves[l];
          const std::uint32_t corner = tree.leaf_corners[l][k][i];
          ASSERT_LT(corner, leaf.vertices);
          EXPECT_EQ(tree.leaf_vertices[leaf.first_vertex + corner],
                    shape.mesh.triangles[tree.leaf_triangles[leaf.first_triangle + i]][k]);
        }
  });
}

TEST(LatticeTree, HasEachVertexOfALeafOnceAndNoneThatNoTriangleUses) {
  for_each_tree([](const BodyShape&, const LatticeTree& tree) {
    for (std::size_t l = 0; l < tree.leaves.size(); ++l) {
      const TreeLeaf& leaf = tree.leaves[l];
      const auto first = tree.leaf_vertices.begin() + leaf.first_vertex;
      std::vector<std::uint32_t> sorted(first, first + leaf.vertices);
      std::sort(sorted.begin(), sorted.end());
      EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end());
      std::vector<bool> used(leaf.vertices, false);
      for (const auto& corner : tree.leaf_corners[l])
        for (std::uint32_t i = 0; i < leaf.triangles; ++i) used.at(corner[i]) = true;
      EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
    }
  });
}

TEST(LatticeTree, OrdersTheVerticesOfALeafInRunsByHomeCell) {
  for_each_tree([](const BodyShape& shape, const LatticeTree& tree) {
    for (const TreeLeaf& leaf : tree.leaves) {
      if (!shape.lattice) {
        EXPECT_EQ(leaf.runs, 0);
      }
      std::uint32_t done = 0;
      for (std::uint32_t r = leaf.first_run; r < leaf.first_run + leaf.runs; ++r) {
        EXPECT_GT(tree.runs[r].count, 0u);
        if (r > leaf.first_run) {
          EXPECT_LT(tree.runs[r - 1].cell, tree.runs[r].cell);
        }
        for (std::uint32_t i = 0; i < tree.runs[r].count; ++i, ++done)
          EXPECT_EQ(shape.embedding.home_cell[tree.leaf_vertices[leaf.first_vertex + done]],
                    tree.runs[r].cell);
      }
      if (shape.lattice) {
        EXPECT_EQ(done, leaf.vertices);
      }
    }
  });
}

TEST(LatticeTree, CopiesTheLocalCoordinatesAndPadsThem) {
  for_each_tree([](const BodyShape& shape, const LatticeTree& tree) {
    for (int k = 0; k < 3; ++k) {
      const std::vector<double>& axis = tree.leaf_local[k];
      ASSERT_EQ(axis.size(), shape.lattice ? tree.leaf_vertices.size() : 0);
      for (std::size_t i = 0; i + kLeafPadding < axis.size(); ++i)
        EXPECT_EQ(axis[i], shape.embedding.local[tree.leaf_vertices[i]][k]);
    }
  });
}

// The pieces of a block's lane hold the local coordinates of `vertex`, in its home cell.
bool held_by_pieces(const LatticeTree& tree, const TreeBlock& block, std::uint32_t lane,
                    const Embedding& embedding, std::uint32_t vertex) {
  for (std::uint32_t p = block.begin; p < block.end; ++p) {
    const HomePieces& home = tree.pieces[p];
    if (home.cell != embedding.home_cell[vertex] || !(home.children >> lane & 1)) continue;
    const Vec3& x = embedding.local[vertex];
    bool held = true;
    for (int k = 0; k < 3; ++k)
      held = held && home.lo[k][lane] / HomePieces::kSteps <= x[k] &&
             x[k] <= home.hi[k][lane] / HomePieces::kSteps;
    return held;
  }
  return false;
}

TEST(LatticeTree, QuantisesLocalCoordinatesOutward) {
  int pieces_seen = 0;
  for_each_tree([&](const BodyShape& shape, const LatticeTree& tree) {
    if (!shape.lattice) {
      EXPECT_TRUE(tree.pieces.empty() && tree.hulls.empty());
    }
    for (const TreeBlock& block : tree.blocks)
      for (std::uint32_t c = 0; shape.lattice && !block.hull && c < block.children; ++c)
        for (std::uint32_t t : triangles_under(tree, block.child[c]))
          for (std::uint32_t v : shape.mesh.triangles[t]) {
            ASSERT_TRUE(held_by_pieces(tree, block, c, shape.embedding, v)) << v;
            ++pieces_seen;
          }
  });
  EXPECT_GT(pieces_seen, 10000);
}

TEST(LatticeTree, QuantisesByLessThanOneStep) {
  const ShapePtr shape = make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 4), {1, 1, 1});
  const LatticeTree tree = make_lattice_tree(*shape);
  for (const TreeBlock& block : tree.blocks) {
    ASSERT_EQ(block.end, block.begin + 1);
    for (std::uint32_t c = 0; c < block.children; ++c) {
      Aabb local;
      for (std::uint32_t t : triangles_under(tree, block.child[c]))
        for (std::uint32_t v : shape->mesh.triangles[t]) local.extend(shape->embedding.local[v]);
      for (int k = 0; k < 3; ++k) {
        const HomePieces& home = tree.pieces[block.begin];
        EXPECT_LT(local.lo[k] * HomePieces::kSteps - home.lo[k][c], 1.0);
        EXPECT_LT(home.hi[k][c] - local.hi[k] * HomePieces::kSteps, 1.0);
      }
    }
  }
}

TEST(LatticeTree, BoundsBlocksOfManyCellsByHullsAndOfFewByPieces) {
  for_each_tree([](const BodyShape&, const LatticeTree& tree) {
    std::size_t hulls = 0, pieces = 0;
    for (const TreeBlock& block : tree.blocks) {
      if (block.hull) {
        EXPECT_EQ(block.end - block.begin, block.children);
      }
      (block.hull ? hulls : pieces) += block.end - block.begin;
    }
    EXPECT_EQ(hulls, tree.hulls.size());
    EXPECT_EQ(pieces, tree.pieces.size());
  });
  EXPECT_TRUE(make_lattice_tree(*shapes()[2].shape).blocks[0].hull);
  EXPECT_FALSE(make_lattice_tree(*shapes()[0].shape).blocks[0].hull);
}

TEST(LatticeTree, FillsItsLeavesUnderACoarseLattice) {
  for (const ShapePtr& shape : {make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 6), {5, 5, 5}),
                                make_shape(test::unit_box_mesh(41), {4, 4, 4})}) {
    const LatticeTree tree = make_lattice_tree(*shape);
    const auto triangles = static_cast<double>(shape->mesh.triangles.size());
    ASSERT_GT(triangles, 20000);
    EXPECT_GT(triangles / static_cast<double>(tree.leaves.size()), 0.5 * kLeafTriangles);
    EXPECT_LT(static_cast<double>(tree.bytes()) / triangles, 100.0);
  }
}

bool same(const LatticeTree& a, const LatticeTree& b) {
  const auto blocks = [](const TreeBlock& x, const TreeBlock& y) {
    return std::tie(x.children, x.hull, x.begin, x.end) ==
               std::tie(y.children, y.hull, y.begin, y.end) &&
           std::equal(x.child.begin(), x.child.end(), y.child.begin(),
                      [](TreeChild i, TreeChild j) { return i.value == j.value; });
  };
  const auto pieces = [](const HomePieces& x, const HomePieces& y) {
    return std::tie(x.cell, x.children, x.lo, x.hi, x.slab_lo, x.slab_hi) ==
           std::tie(y.cell, y.children, y.lo, y.hi, y.slab_lo, y.slab_hi);
  };
  const auto slabs = [](const BlockSlabs& x, const BlockSlabs& y) { return x.normal == y.normal; };
  const auto hulls = [](const HullChild& x, const HullChild& y) {
    return std::tie(x.node_begin, x.node_end, x.reach) ==
           std::tie(y.node_begin, y.node_end, y.reach);
  };
  return std::equal(a.blocks.begin(), a.blocks.end(), b.blocks.begin(), b.blocks.end(), blocks) &&
         std::equal(a.pieces.begin(), a.pieces.end(), b.pieces.begin(), b.pieces.end(), pieces) &&
         std::equal(a.slabs.begin(), a.slabs.end(), b.slabs.begin(), b.slabs.end(), slabs) &&
         std::equal(a.hulls.begin(), a.hulls.end(), b.hulls.begin(), b.hulls.end(), hulls) &&
         a.hull_nodes == b.hull_nodes && a.leaf_triangles == b.leaf_triangles &&
         a.leaf_corners == b.leaf_corners && a.leaf_vertices == b.leaf_vertices &&
         a.leaf_local == b.leaf_local;
}

TEST(LatticeTree, IsTheSameEveryTime) {
  for_each_tree([](const BodyShape& shape, const LatticeTree& tree) {
    EXPECT_TRUE(same(tree, make_lattice_tree(shape)));
  });
  EXPECT_FALSE(same(make_lattice_tree(*shapes()[0].shape), make_lattice_tree(*shapes()[1].shape)));
}

TEST(PartitionTriangles, IsAPermutationOfRangesThatNestAndFollow) {
  for (const NamedShape& named : shapes()) {
    const Partition partition = partition_triangles(*named.shape);
    std::vector<std::uint32_t> sorted = partition.order;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t t = 0; t < sorted.size(); ++t) ASSERT_EQ(sorted[t], t) << named.name;
    std::vector<const Part*> open = {&partition.root};
    while (!open.empty()) {
      const Part& part = *open.back();
      open.pop_back();
      std::uint32_t at = part.first;
      for (const Part& child : part.children) {
        EXPECT_EQ(child.first, at) << named.name;
        EXPECT_GT(child.last, child.first) << named.name;
        at = child.last;
        open.push_back(&child);
      }
      if (!part.children.empty()) {
        EXPECT_EQ(at, part.last) << named.name;
      }
    }
  }
}

}  // namespace
}  // namespace contactcheck
