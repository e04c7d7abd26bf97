// The tree at rest: what stands in it, once and in the right place.

#include "core/lazy/lattice_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "core/lazy/partition.h"
#include "tests/core/lazy/bounds_cases.h"
#include "tests/core/lazy/one_body.h"

namespace contactcheck {
namespace {

using test::triangles_under;

TriangleMesh first_triangles(TriangleMesh mesh, std::size_t count) {
  mesh.triangles.resize(count);
  return mesh;
}

const std::vector<test::NamedShape>& tree_shapes() {
  static const std::vector<test::NamedShape> all = [] {
    const TriangleMesh ball = test::sphere_mesh(Vec3::Zero(), 1.0, 4);
    const TriangleMesh box = test::unit_box_mesh(12);
    return std::vector<test::NamedShape>{
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
  for (const test::NamedShape& named : tree_shapes()) {
    SCOPED_TRACE(named.name);
    check(*named.shape, make_lattice_tree(*named.shape));
  }
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
      EXPECT_GE(tree.blocks[b].children, b == 0 ? 1u : 2u);
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

struct Lane {
  const PieceLanes& pieces;
  std::size_t lane;
  double lo(int k) const { return pieces.lo[k][lane] / PieceLanes::kSteps; }
  double hi(int k) const { return pieces.hi[k][lane] / PieceLanes::kSteps; }
};

// Of a child, in one home cell: the lanes that hold it, repeats among them.
std::vector<Lane> lanes_of(const LatticeTree& tree, const TreeBlock& block, std::uint32_t child,
                           std::uint32_t cell) {
  std::vector<Lane> out;
  for (std::uint32_t p = block.begin; p < block.end; ++p)
    for (std::size_t lane = 0; lane < kBlockWidth; ++lane)
      if (tree.pieces[p].child[lane] == child && tree.pieces[p].cell[lane] == cell)
        out.push_back({tree.pieces[p], lane});
  return out;
}

Vec3 centred(const Embedding& embedding, std::uint32_t vertex) {
  return 2.0 * embedding.local[vertex] - Vec3::Ones();
}

bool held(const Lane& lane, const Vec3& y) {
  for (int k = 0; k < 3; ++k)
    if (!(lane.lo(k) <= y[k] && y[k] <= lane.hi(k))) return false;
  return true;
}

TEST(LatticeTree, QuantisesLocalCoordinatesOutward) {
  int vertices = 0;
  for_each_tree([&](const BodyShape& shape, const LatticeTree& tree) {
    EXPECT_EQ(tree.pieces.empty(), !shape.lattice);
    for (const TreeBlock& block : tree.blocks)
      for (std::uint32_t c = 0; shape.lattice && c < block.children; ++c)
        for (std::uint32_t t : triangles_under(tree, block.child[c]))
          for (std::uint32_t v : shape.mesh.triangles[t]) {
            const auto lanes = lanes_of(tree, block, c, shape.embedding.home_cell[v]);
            ASSERT_FALSE(lanes.empty()) << v;
            for (const Lane& lane : lanes) ASSERT_TRUE(held(lane, centred(shape.embedding, v)));
            ++vertices;
          }
  });
  EXPECT_GT(vertices, 10000);
}

// Along the normal that is stored, which is what the bounds are made with.
void expect_slabs_hold(const BodyShape& shape, const LatticeTree& tree) {
  for (std::size_t b = 0; b < tree.blocks.size(); ++b)
    for (std::uint32_t c = 0; c < tree.blocks[b].children; ++c) {
      Vec3 m;
      for (int k = 0; k < 3; ++k) m[k] = tree.slabs[b].normal[k][c];
      EXPECT_EQ(m.cwiseAbs().maxCoeff() > 0.0, true);
      for (std::uint32_t t : triangles_under(tree, tree.blocks[b].child[c]))
        for (std::uint32_t v : shape.mesh.triangles[t])
          for (const Lane& lane : lanes_of(tree, tree.blocks[b], c, shape.embedding.home_cell[v])) {
            const double along = m.dot(centred(shape.embedding, v));
            EXPECT_LE(lane.pieces.slab_lo[lane.lane], along);
            EXPECT_GE(lane.pieces.slab_hi[lane.lane], along);
          }
    }
}

TEST(LatticeTree, SlabsHoldTheirVertices) {
  for_each_tree([](const BodyShape& shape, const LatticeTree& tree) {
    if (shape.lattice) expect_slabs_hold(shape, tree);
  });
}

// Products of two sides overflow, and their difference is no number.
TEST(LatticeTree, SlabsHoldVerticesWhoseNormalIsNoNumber) {
  for (int axis = 0; axis < 3; ++axis) {
    SCOPED_TRACE(axis);
    const auto turned = [axis](double x, double flat, double z) {
      Vec3 out;
      out[(axis + 2) % 3] = x, out[axis] = flat, out[(axis + 1) % 3] = z;
      return out;
    };
    const TriangleMesh mesh = test::triangle_mesh(
        turned(-1e160, 1e-200, -1e160), turned(1e160, -1e-200, 0), turned(0, 2e-200, 1e160));
    std::array<std::vector<double>, 3> lines;
    lines.fill({-1.1e160, 1.1e160});
    lines[axis] = {-1e159, 3e160};  // the triangle is at one end of its cell
    const auto shape = make_shape_on_lines(mesh, lines);
    expect_slabs_hold(*shape, make_lattice_tree(*shape));
    test::OneBody body(shape, false);
    body.begin(test::rest_nodes_at(*shape, Vec3::Zero()));
    EXPECT_EQ(body.broken(lazy_kernels()), "");
  }
}

TEST(LatticeTree, QuantisesByAboutOneStep) {
  constexpr double kStep = 1.001 / PieceLanes::kSteps;
  const test::ShapePtr shape = make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 4), {1, 1, 1});
  const LatticeTree tree = make_lattice_tree(*shape);
  for (const TreeBlock& block : tree.blocks) {
    ASSERT_EQ(block.end, block.begin + 1);
    for (std::uint32_t c = 0; c < block.children; ++c) {
      Aabb local;
      for (std::uint32_t t : triangles_under(tree, block.child[c]))
        for (std::uint32_t v : shape->mesh.triangles[t]) local.extend(centred(shape->embedding, v));
      const Lane lane{tree.pieces[block.begin], c};
      for (int k = 0; k < 3; ++k) {
        EXPECT_LT(local.lo[k] - lane.lo(k), kStep);
        EXPECT_LT(lane.hi(k) - local.hi[k], kStep);
      }
    }
  }
}

// Lanes that do not repeat lane 0 are full but for the last of a block.
TEST(LatticeTree, GivesTheFirstLanesToTheChildrenAndPacksTheOthers) {
  int packed = 0;
  for_each_tree([&](const BodyShape& shape, const LatticeTree& tree) {
    std::uint32_t next = 0;
    for (const TreeBlock& block : tree.blocks) {
      if (!shape.lattice) continue;
      EXPECT_EQ(block.begin, next);
      next = block.end;
      std::set<std::pair<std::uint32_t, std::uint32_t>> distinct;
      for (std::uint32_t c = 0; c < block.children; ++c)
        EXPECT_EQ(tree.pieces[block.begin].child[c], c);
      for (std::uint32_t p = block.begin; p < block.end; ++p)
        for (std::size_t lane = 0; lane < kBlockWidth; ++lane)
          distinct.insert({tree.pieces[p].child[lane], tree.pieces[p].cell[lane]});
      const std::size_t others = distinct.size() - block.children;
      EXPECT_EQ(block.end - block.begin, 1 + (others + kBlockWidth - 1) / kBlockWidth);
      packed += others > kBlockWidth;
    }
    EXPECT_EQ(next, tree.pieces.size());
  });
  EXPECT_GT(packed, 10);
}

TEST(LatticeTree, FillsItsLeavesUnderACoarseLattice) {
  for (const test::ShapePtr& shape :
       {make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 6), {5, 5, 5}),
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
    return std::tie(x.children, x.begin, x.end) == std::tie(y.children, y.begin, y.end) &&
           std::equal(x.child.begin(), x.child.end(), y.child.begin(),
                      [](TreeChild i, TreeChild j) { return i.value == j.value; });
  };
  const auto pieces = [](const PieceLanes& x, const PieceLanes& y) {
    return std::tie(x.cell, x.child, x.lo, x.hi, x.slab_lo, x.slab_hi) ==
           std::tie(y.cell, y.child, y.lo, y.hi, y.slab_lo, y.slab_hi);
  };
  const auto slabs = [](const BlockSlabs& x, const BlockSlabs& y) { return x.normal == y.normal; };
  return std::equal(a.blocks.begin(), a.blocks.end(), b.blocks.begin(), b.blocks.end(), blocks) &&
         std::equal(a.pieces.begin(), a.pieces.end(), b.pieces.begin(), b.pieces.end(), pieces) &&
         std::equal(a.slabs.begin(), a.slabs.end(), b.slabs.begin(), b.slabs.end(), slabs) &&
         a.leaf_triangles == b.leaf_triangles && a.leaf_corners == b.leaf_corners &&
         a.leaf_vertices == b.leaf_vertices && a.leaf_local == b.leaf_local;
}

TEST(LatticeTree, IsTheSameEveryTime) {
  for_each_tree([](const BodyShape& shape, const LatticeTree& tree) {
    EXPECT_TRUE(same(tree, make_lattice_tree(shape)));
  });
  EXPECT_FALSE(
      same(make_lattice_tree(*tree_shapes()[0].shape), make_lattice_tree(*tree_shapes()[1].shape)));
}

TEST(PartitionTriangles, IsAPermutationOfRangesThatNestAndFollow) {
  for (const test::NamedShape& named : tree_shapes()) {
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
