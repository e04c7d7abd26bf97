#include "reference/oracle/surface_tree.h"

#include <gmock/gmock.h>

#include <set>

#include "tests/reference/oracle/meshes.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {
namespace {

using oracle::SurfaceTree;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

Aabb box_of(const oracle::TriangleCorners& t) {
  Aabb box;
  for (const Vec3& p : t) box.extend(p);
  return box;
}

std::multiset<Pair> pairs_of(const SurfaceTree& a, const SurfaceTree& b) {
  std::multiset<Pair> pairs;
  oracle::any_box_pair(a, b, [&](std::uint32_t i, std::uint32_t j) {
    pairs.emplace(i, j);
    return false;
  });
  return pairs;
}

std::multiset<Pair> all_overlapping(const SurfaceTree& a, std::uint32_t count_a,
                                    const SurfaceTree& b, std::uint32_t count_b) {
  std::multiset<Pair> pairs;
  for (std::uint32_t i = 0; i < count_a; ++i)
    for (std::uint32_t j = 0; j < count_b; ++j)
      if (box_of(a.corners(i)).overlaps(box_of(b.corners(j)))) pairs.emplace(i, j);
  return pairs;
}

TEST(SurfaceTree, HoldsEveryTriangleOnceAfterRefit) {
  const TriangleMesh mesh = torus_mesh(1.0, 0.3, 20, 10);
  SurfaceTree tree(mesh);
  tree.refit(mesh.vertices);
  EXPECT_TRUE(tree.validate());
  TriangleSource source(201);
  const auto vertices = moved(mesh.vertices, random_rotation(source), Vec3(1, 2, 3));
  tree.refit(vertices);
  EXPECT_TRUE(tree.validate());
  std::vector<Vec3> crumpled;
  for (const Vec3& p : mesh.vertices) crumpled.push_back(source.point(p, 2.0));
  tree.refit(crumpled);
  EXPECT_TRUE(tree.validate());
}

TEST(SurfaceTree, PairsAreThoseWhoseBoxesOverlap) {
  const TriangleMesh a = torus_mesh(1.0, 0.4, 16, 10), b = sphere_mesh(Vec3::Zero(), 0.8, 3);
  SurfaceTree tree_a(a), tree_b(b);
  TriangleSource source(202);
  std::size_t found = 0;
  for (int i = 0; i < 6; ++i) {
    const auto va = moved(a.vertices, random_rotation(source), source.point(Vec3::Zero(), 0.5));
    const auto vb = moved(b.vertices, random_rotation(source), source.point(Vec3::Zero(), 0.5));
    tree_a.refit(va);
    tree_b.refit(vb);
    const auto expected = all_overlapping(tree_a, static_cast<std::uint32_t>(a.triangles.size()),
                                          tree_b, static_cast<std::uint32_t>(b.triangles.size()));
    EXPECT_EQ(pairs_of(tree_a, tree_b), expected);
    found += expected.size();
  }
  EXPECT_GT(found, 500u);
}

TEST(SurfaceTree, BoxesThatOnlyTouchArePairs) {
  const TriangleMesh a = unit_box_mesh(2);
  const TriangleMesh b = box_mesh(Vec3(1, 1, 1), Vec3(2, 2, 2), 2);
  SurfaceTree tree_a(a), tree_b(b);
  tree_a.refit(a.vertices);
  tree_b.refit(b.vertices);
  const auto expected = all_overlapping(tree_a, 48, tree_b, 48);
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(pairs_of(tree_a, tree_b), expected);
  EXPECT_EQ(pairs_of(tree_b, tree_a), all_overlapping(tree_b, 48, tree_a, 48));
}

TEST(SurfaceTree, VisitStopsWhenTold) {
  const TriangleMesh mesh = unit_box_mesh(3);
  SurfaceTree tree(mesh);
  tree.refit(mesh.vertices);
  int visits = 0;
  const bool stopped =
      oracle::any_box_pair(tree, tree, [&](std::uint32_t, std::uint32_t) { return ++visits == 5; });
  EXPECT_TRUE(stopped);
  EXPECT_EQ(visits, 5);
}

TEST(SurfaceTree, SingleTriangle) {
  const TriangleMesh mesh = triangle_mesh(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  SurfaceTree tree(mesh);
  tree.refit(mesh.vertices);
  EXPECT_TRUE(tree.validate());
  EXPECT_EQ(pairs_of(tree, tree).size(), 1u);
}

}  // namespace
}  // namespace contactcheck::test
