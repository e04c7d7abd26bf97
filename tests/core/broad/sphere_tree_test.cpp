#include "core/broad/sphere_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

Lattice sample_lattice() {
  return make_lattice(test::sphere_mesh({1, 2, 3}, 1.0, 2), {5, 4, 5}, 0.02);
}

std::vector<std::uint32_t> every_cell(const Lattice& lattice) {
  std::vector<std::uint32_t> cells(lattice.cells.size());
  std::iota(cells.begin(), cells.end(), 0u);
  return cells;
}

// Union of a level's cells, with repeats, sorted.
std::vector<std::uint32_t> cells_of(const std::vector<SphereNode>& level) {
  std::vector<std::uint32_t> cells;
  for (const SphereNode& s : level) cells.insert(cells.end(), s.cells.begin(), s.cells.end());
  std::sort(cells.begin(), cells.end());
  return cells;
}

TEST(SphereTree, EveryLevelPartitionsTheCells) {
  const Lattice lattice = sample_lattice();
  const auto all = every_cell(lattice);
  for (int children : {1, 2, 4, 16}) {
    const SphereTree tree = make_sphere_tree(lattice, all, 4, children);
    ASSERT_EQ(tree.levels.size(), 4u);
    EXPECT_EQ(tree.levels[0].size(), 1u);
    for (const auto& level : tree.levels) EXPECT_EQ(cells_of(level), all);
  }
}

TEST(SphereTree, ChildrenHoldPartsOfTheirParentsAndStandTogether) {
  const Lattice lattice = sample_lattice();
  const SphereTree tree = make_sphere_tree(lattice, every_cell(lattice), 3, 4);
  EXPECT_GT(tree.levels[1].size(), 2u);
  EXPECT_GT(tree.levels[2].size(), tree.levels[1].size());
  for (std::size_t l = 1; l < tree.levels.size(); ++l) {
    std::vector<int> children(tree.levels[l - 1].size(), 0);
    std::uint32_t last = 0;
    for (const SphereNode& s : tree.levels[l]) {
      EXPECT_FALSE(s.cells.empty());
      EXPECT_GE(s.parent, last);
      last = s.parent;
      ++children[s.parent];
      const auto& above = tree.levels[l - 1][s.parent].cells;
      for (std::uint32_t cell : s.cells)
        EXPECT_NE(std::find(above.begin(), above.end(), cell), above.end());
    }
    for (int count : children) {
      EXPECT_GE(count, 1);
      EXPECT_LE(count, 4);
    }
  }
}

TEST(SphereTree, CentresAreDifferentNodesOfTheParentsCells) {
  const Lattice lattice = sample_lattice();
  const SphereTree tree = make_sphere_tree(lattice, every_cell(lattice), 3, 4);
  for (std::size_t l = 1; l < tree.levels.size(); ++l) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
    for (const SphereNode& s : tree.levels[l]) {
      EXPECT_TRUE(seen.insert({s.parent, s.center_node}).second);
      std::set<std::uint32_t> nodes;
      for (std::uint32_t cell : tree.levels[l - 1][s.parent].cells)
        nodes.insert(lattice.cell_nodes[cell].begin(), lattice.cell_nodes[cell].end());
      EXPECT_EQ(nodes.count(s.center_node), 1u);
    }
  }
}

TEST(SphereTree, CellsGoToTheNearestCentre) {
  const Lattice lattice = sample_lattice();
  const SphereTree tree = make_sphere_tree(lattice, every_cell(lattice), 2, 6);
  for (const SphereNode& s : tree.levels[1])
    for (std::uint32_t cell : s.cells) {
      const Vec3 at = lattice.cell_box(cell).center();
      double nearest = std::numeric_limits<double>::infinity();
      for (const SphereNode& other : tree.levels[1])
        nearest = std::min(nearest, (lattice.rest_node(other.center_node) - at).norm());
      EXPECT_LE((lattice.rest_node(s.center_node) - at).norm(), nearest + 1e-12);
    }
}

TEST(SphereTree, IsDeterministic) {
  const Lattice lattice = sample_lattice();
  const SphereTree a = make_sphere_tree(lattice, every_cell(lattice), 3, 5);
  const SphereTree b = make_sphere_tree(lattice, every_cell(lattice), 3, 5);
  for (std::size_t l = 0; l < a.levels.size(); ++l) {
    ASSERT_EQ(a.levels[l].size(), b.levels[l].size());
    for (std::size_t s = 0; s < a.levels[l].size(); ++s) {
      EXPECT_EQ(a.levels[l][s].center_node, b.levels[l][s].center_node);
      EXPECT_EQ(a.levels[l][s].cells, b.levels[l][s].cells);
    }
  }
}

TEST(SphereTree, HandComputedBarOfThreeCells) {
  Lattice lattice = make_lattice(test::box_mesh({0, 0, 0}, {3, 1, 1}, 3), {3, 1, 1}, 0.02);
  const SphereTree tree = make_sphere_tree(lattice, every_cell(lattice), 2, 2);
  // The nodes nearest the middle are those of the inner planes; the lowest of them, node 1 at the
  // low corner of cell 1, comes first. Farthest from it: the high corner of cell 2, node 15.
  ASSERT_EQ(tree.levels[1].size(), 2u);
  EXPECT_EQ(tree.levels[1][0].center_node, 1u);
  EXPECT_EQ(tree.levels[1][1].center_node, 15u);
  EXPECT_EQ(tree.levels[1][0].cells, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(tree.levels[1][1].cells, (std::vector<std::uint32_t>{2}));
}

TEST(SphereTree, MoreChildrenThanCellsGivesAtMostOnePerCell) {
  const Lattice lattice = make_lattice(test::box_mesh({0, 0, 0}, {5, 1, 1}, 5), {5, 1, 1}, 0.02);
  const SphereTree tree = make_sphere_tree(lattice, every_cell(lattice), 3, 1000);
  for (std::size_t l : {1u, 2u}) {
    EXPECT_GE(tree.levels[l].size(), 3u);
    EXPECT_LE(tree.levels[l].size(), 5u);
    EXPECT_EQ(cells_of(tree.levels[l]), every_cell(lattice));
  }
}

TEST(SphereTree, OfSomeCellsHoldsOnlyThose) {
  const Lattice lattice = sample_lattice();
  const std::vector<std::uint32_t> some = {3, 4, 9, 20};
  const SphereTree tree = make_sphere_tree(lattice, some, 2, 3);
  EXPECT_EQ(cells_of(tree.levels[1]), some);
}

TEST(SphereTree, WithoutCellsHasOnlyItsTop) {
  const SphereTree tree = make_sphere_tree(sample_lattice(), {}, 3, 4);
  EXPECT_EQ(tree.levels[0].size(), 1u);
  EXPECT_TRUE(tree.levels[1].empty());
  EXPECT_TRUE(tree.levels[2].empty());
}

}  // namespace
}  // namespace contactcheck
