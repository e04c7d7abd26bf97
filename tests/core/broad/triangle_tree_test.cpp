#include "core/broad/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

TriangleMesh strip(std::uint32_t count) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < count + 2; ++i) mesh.vertices.emplace_back(i, i % 2, 0);
  for (std::uint32_t i = 0; i < count; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
  return mesh;
}

/// All triangles at one place: nothing tells them apart.
TriangleMesh heap(std::uint32_t count) {
  TriangleMesh mesh = test::triangle_mesh(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  mesh.triangles.resize(count, mesh.triangles[0]);
  return mesh;
}

/// Each triangle twice as far out as the one before: splits in space peel off a few at a time.
TriangleMesh spiral(std::uint32_t count) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = std::ldexp(1.0, static_cast<int>(i) - 1000);
    for (const Vec3& p : {Vec3(x, 0, 0), Vec3(x, x, 0), Vec3(x, 0, x)}) mesh.vertices.push_back(p);
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

TriangleMesh scaled(TriangleMesh mesh, double scale) {
  for (Vec3& v : mesh.vertices) v *= scale;
  return mesh;
}

std::vector<TriangleMesh> meshes() {
  std::vector<TriangleMesh> out = {test::triangle_mesh(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)),
                                   strip(2),
                                   strip(1000),
                                   heap(77),
                                   spiral(1900),
                                   test::sphere_mesh(Vec3(1, 2, 3), 1.0, 3)};
  for (double scale : {1e-300, 0x1p-1074, 1e160, 1.7e308})
    out.push_back(scaled(test::sphere_mesh(Vec3::Zero(), 1.0, 2), scale));
  return out;
}

std::size_t depth(const TriangleTree& tree, std::uint32_t node = 0) {
  const TriangleTree::Node& n = tree.nodes[node];
  return n.leaf() ? 0 : 1 + std::max(depth(tree, n.first), depth(tree, n.first + 1));
}

TEST(TriangleTree, HoldsEveryTriangleInExactlyOneLeafOfAtMostLeafSize) {
  for (const TriangleMesh& mesh : meshes()) {
    for (std::uint32_t leaf : {1u, 4u, 64u}) {
      const TriangleTree tree = make_triangle_tree(mesh, leaf);
      EXPECT_EQ(tree.validate(mesh), "");
      for (const TriangleTree::Node& node : tree.nodes) EXPECT_LE(node.count, leaf);
      EXPECT_EQ(tree.nodes[0].leaf(), mesh.triangles.size() <= leaf);
    }
  }
}

TEST(TriangleTree, DepthHasItsLimit) {
  std::size_t deepest = 0;
  for (const TriangleMesh& mesh : meshes()) {
    const TriangleTree tree = make_triangle_tree(mesh, 1);
    EXPECT_LE(depth(tree), 2 * std::bit_width(mesh.triangles.size()) + 32);
    deepest = std::max(deepest, depth(tree));
  }
  EXPECT_GT(deepest, 20u);  // the spiral is worse than halves: the limit was put to use
  EXPECT_EQ(depth(make_triangle_tree(heap(64), 1)), 6u);
}

TEST(TriangleTree, IsTheSameEveryTime) {
  const TriangleMesh mesh = test::sphere_mesh(Vec3(1, 2, 3), 1.0, 3);
  EXPECT_EQ(make_triangle_tree(mesh, 4).ids, make_triangle_tree(mesh, 4).ids);
  // What lies near in space lies near in the tree: a ball is no list in the order of the input.
  std::vector<std::uint32_t> ids = make_triangle_tree(mesh, 4).ids;
  EXPECT_FALSE(std::is_sorted(ids.begin(), ids.end()));
}

TEST(TriangleTree, ValidateNamesEachFault) {
  const TriangleMesh mesh = strip(9);
  const TriangleTree good = make_triangle_tree(mesh, 2);
  const auto leaf = static_cast<std::size_t>(
      std::find_if(good.nodes.begin(), good.nodes.end(), [](const auto& n) { return n.leaf(); }) -
      good.nodes.begin());
  const auto fault = [&](auto&& damage) {
    TriangleTree bad = good;
    damage(bad);
    return bad.validate(mesh);
  };
  const std::string name = "node " + std::to_string(leaf);
  EXPECT_EQ(fault([](auto& t) {
              t.ids[4] = t.ids[3];
              t.corners[4] = t.corners[3];
            }),
            "slot 4 holds a triangle again");
  EXPECT_EQ(fault([](auto& t) { t.ids[3] = 9; }), "slot 3 holds no triangle");
  EXPECT_EQ(fault([](auto& t) { std::swap(t.corners[0], t.corners[1]); }),
            "slot 0 has other corners than its triangle");
  EXPECT_EQ(fault([](auto& t) { t.ids.pop_back(); }).substr(0, 5), "node ");
  EXPECT_EQ(fault([](auto& t) { t.nodes[0].first = 0; }), "node 0 has a child before itself");
  EXPECT_EQ(fault([&](auto& t) { t.nodes[leaf].count = 99; }), name + " points behind the end");
  EXPECT_EQ(fault([](auto& t) { t.nodes[0].first = 3; }), "node 1 is not the child of one");
  EXPECT_NE(fault([&](auto& t) { ++t.nodes[leaf].first; }), "");
}

TEST(TriangleTree, InstancesShareOne) {
  const auto ball = make_bare_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 1));
  const auto box = make_bare_shape(test::unit_box_mesh(1));
  const auto trees = make_triangle_trees({{"a", ball}, {"b", box}, {"c", ball}}, 4);
  ASSERT_EQ(trees.size(), 3u);
  EXPECT_EQ(trees[0], trees[2]);
  EXPECT_EQ(trees[0]->validate(ball->mesh), "");
  EXPECT_EQ(trees[1]->validate(box->mesh), "");
}

/// Intervals on a line instead of volumes: all that the traversal asks for.
struct Intervals {
  explicit Intervals(const TriangleTree& t, double shift) : tree_(t), ends(t.nodes.size()) {
    for (std::size_t n = ends.size(); n-- > 0;) {
      const TriangleTree::Node node = t.nodes[n];
      ends[n] = node.leaf()
                    ? std::pair(t.ids[node.first] + shift, t.ids[node.first] + shift + 0.5)
                    : std::pair(std::min(ends[node.first].first, ends[node.first + 1].first),
                                std::max(ends[node.first].second, ends[node.first + 1].second));
    }
  }
  const TriangleTree& tree() const { return tree_; }
  double size(std::uint32_t n) const { return ends[n].second - ends[n].first; }
  bool overlap(std::uint32_t n, const Intervals& other, std::uint32_t m) const {
    return ends[n].first <= other.ends[m].second && other.ends[m].first <= ends[n].second;
  }
  const TriangleTree& tree_;
  std::vector<std::pair<double, double>> ends;
};

TEST(TraversePairs, VisitsEveryTwoOverlappingLeavesOnceAndStopsWhenTold) {
  const TriangleTree tree = make_triangle_tree(strip(50), 1),
                     small = make_triangle_tree(strip(3), 1);
  const Intervals a(tree, 0.0), b(small, 20.25);  // each of b meets one of a: 20, 21, 22
  std::vector<NodePair> stack;
  std::uint64_t visited = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> met;
  traverse_pairs(a, b, stack, visited, [&](std::uint32_t i, std::uint32_t j) {
    met.emplace_back(tree.ids[tree.nodes[i].first], small.ids[small.nodes[j].first]);
    return false;
  });
  std::sort(met.begin(), met.end());
  EXPECT_EQ(met, (decltype(met){{20, 0}, {21, 1}, {22, 2}}));
  EXPECT_GT(visited, 3u);
  EXPECT_LT(visited, 50u);
  int calls = 0;
  traverse_pairs(a, b, stack, visited, [&](std::uint32_t, std::uint32_t) { return ++calls == 2; });
  EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace contactcheck
