#include "reference/oracle/simple_solid.h"

#include <gtest/gtest.h>

#include <string>

#include "core/types/mesh_topology.h"
#include "tests/reference/oracle/drawn_solids.h"
#include "tests/reference/oracle/meshes.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {
namespace {

// "simple", or the fault.
std::string judged(const TriangleMesh& mesh) {
  oracle::SurfaceTree tree(mesh);
  tree.refit(mesh.vertices);
  const auto fault = oracle::solid_fault(tree, mesh.triangles, mesh.vertices);
  return fault ? oracle::describe(*fault, {}) : "simple";
}

// All on both sides.
TriangleMesh double_sided(const TriangleMesh& mesh) { return joined(mesh, reversed(mesh)); }

TriangleMesh box(double lo, double hi) {
  return box_mesh(Vec3::Constant(lo), Vec3::Constant(hi), 2);
}

TEST(SimpleSolid, KindsOfSolidsAreSimple) {
  TriangleSource source(821);
  for (int kind = 0; kind < kSolidKinds; ++kind)
    EXPECT_EQ(judged(drawn_solid(source, kind)), "simple") << kind;
}

TEST(SimpleSolid, DoubledVerticesInsideOutAndAnyScaleAreSimple) {
  TriangleMesh mesh = box(-1, 1);
  EXPECT_EQ(judged(with_own_corners(mesh)), "simple");
  EXPECT_EQ(judged(reversed(with_own_corners(mesh))), "simple");
  for (const double scale : {1e-300, 1e-150, 1e150, 1e300})
    EXPECT_EQ(judged({scaled(mesh.vertices, scale), mesh.triangles}), "simple") << scale;
}

TEST(SimpleSolid, PartsThatShareAnEdgeOrACornerAreSimple) {
  for (const Vec3& at : {Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
    const TriangleMesh pair = joined(unit_box_mesh(1), box_mesh(at, at + Vec3::Ones(), 1));
    EXPECT_EQ(judged(pair), "simple");
    EXPECT_EQ(judged(with_own_corners(pair)), "simple");
  }
}

TEST(SimpleSolid, AVertexThatNoTriangleUsesIsNoPartOfIt) {
  TriangleMesh mesh = box(0, 1);
  mesh.vertices.emplace_back(0.5, 0.5, 1);
  EXPECT_EQ(judged(mesh), "simple");
}

TEST(SimpleSolid, OpenIsToldWithItsEdge) {
  TriangleMesh mesh = unit_box_mesh(1);
  mesh.triangles.pop_back();
  EXPECT_THAT(judged(mesh), testing::StartsWith("open (edge of vertices "));
  EXPECT_THAT(judged(triangle_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0})), testing::StartsWith("open"));
}

TEST(SimpleSolid, PartsThatCrossOrTouchAreSelfContact) {
  EXPECT_EQ(judged(joined(box(0, 2), box(0.75, 3))), "self-contact");
  EXPECT_EQ(judged(joined(box(0, 2), box_mesh({2, 0.5, 0.5}, {3, 1.5, 1.5}, 1))), "self-contact");
  EXPECT_EQ(judged(joined(box_mesh({0, 0, 0}, {2, 2, 2}, 1), box_mesh({2, 1, 1}, {3, 3, 3}, 1))),
            "self-contact");
}

TEST(SimpleSolid, MoreNeighboursThanAreJudgedCountAsSelfContact) {
  // A double cone: n triangles at each tip, n (n - 1) pairs.
  constexpr int kSides = 7000;
  TriangleMesh cone;
  for (const auto& p : circle_points(kSides)) cone.vertices.emplace_back(p.x(), p.y(), 0);
  cone.vertices.insert(cone.vertices.end(), {{0, 0, 1}, {0, 0, -1}});
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t j = (i + 1) % kSides;
    cone.triangles.push_back({i, j, kSides});
    cone.triangles.push_back({j, i, kSides + 1});
  }
  EXPECT_EQ(judged(cone), "self-contact");
}

TEST(SimpleSolid, DoubleSidedClothHasNoInterior) {
  TriangleMesh cloth = unit_box_mesh(2);
  cloth.triangles.resize(8);
  EXPECT_EQ(judged(double_sided(cloth)), "no interior");
  EXPECT_EQ(judged(double_sided(triangle_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}))), "no interior");
}

TEST(SimpleSolid, OnePartWithoutInteriorSpoilsTheBody) {
  TriangleMesh sheet = triangle_mesh({8, 0, 0}, {9, 0, 0}, {8, 1, 0});
  EXPECT_EQ(judged(joined(box(0, 1), double_sided(sheet))), "no interior");
  // A wall within a box, between its edges.
  TriangleMesh walled = unit_box_mesh(1);
  const TriangleMesh wall{{{0, 0, 0}, {1, 1, 0}, {1, 1, 1}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
  walled = joined(walled, double_sided(wall));
  EXPECT_NE(judged(walled), "simple");
}

TEST(SimpleSolid, AllTrianglesTwiceAreNested) {
  const TriangleMesh twice = joined(box(0, 1), box(0, 1));
  EXPECT_EQ(judged(twice), "nested");
}

TEST(SimpleSolid, ShellsInShellsAreNestedUnlessTheyMakeACavity) {
  EXPECT_EQ(judged(joined(box(-2, 2), box(-1, 1))), "nested");
  EXPECT_EQ(judged(joined(box(-2, 2), reversed(box(-1, 1)))), "simple");
  EXPECT_EQ(judged(joined(joined(box(-3, 3), reversed(box(-2, 2))), box(-1, 1))), "simple");
  EXPECT_EQ(judged(joined(joined(box(-3, 3), box(-2, 2)), box(-1, 1))), "nested");
}

TEST(SimpleSolid, PartsThatCrossAlongCommonEdgesAloneAreNested) {
  EXPECT_EQ(judged(joined(box(0, 2), box(1, 3))), "nested");
}

}  // namespace
}  // namespace contactcheck::test
