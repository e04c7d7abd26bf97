#include "core/types/mesh_edges.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::uint32_t kNone = MeshEdges::kNone;

/// What is wrong with the edges of a mesh, by the definition; empty if nothing is.
std::string fault(const std::vector<Triangle>& triangles, const MeshEdges& found) {
  std::set<Edge> sides;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = t[i], w = t[(i + 1) % 3];
      if (v != w) sides.insert({std::min(v, w), std::max(v, w)});
    }
  if (found.edges != std::vector<Edge>(sides.begin(), sides.end()))
    return "not each side once, ascending";
  if (found.of_triangle.size() != triangles.size()) return "not one entry per triangle";
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = triangles[t][i], w = triangles[t][(i + 1) % 3];
      const std::uint32_t number = found.of_triangle[t][i];
      const std::string side = "side " + std::to_string(i) + " of triangle " + std::to_string(t);
      if (v == w && number != kNone) return side + " is no edge";
      if (v == w) continue;
      if (number >= found.edges.size()) return side + " has no edge";
      const Edge& edge = found.edges[number];
      if (edge != Edge{v, w} && edge != Edge{w, v}) return side + " has another one's edge";
    }
  return "";
}

TEST(MeshEdges, TetrahedronHasSix) {
  const std::vector<Triangle> triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  const MeshEdges found = mesh_edges(triangles);
  EXPECT_THAT(found.edges,
              ElementsAre(Edge{0, 1}, Edge{0, 2}, Edge{0, 3}, Edge{1, 2}, Edge{1, 3}, Edge{2, 3}));
  using Sides = std::array<std::uint32_t, 3>;
  EXPECT_THAT(found.of_triangle,
              ElementsAre(Sides{1, 3, 0}, Sides{0, 4, 2}, Sides{3, 5, 4}, Sides{2, 5, 1}));
}

TEST(MeshEdges, SharedEdgesAreOnceWhateverTheirDirection) {
  const MeshEdges found = mesh_edges(std::vector<Triangle>{{9, 4, 7}, {4, 9, 2}, {9, 4, 1}});
  EXPECT_THAT(found.edges, ElementsAre(Edge{1, 4}, Edge{1, 9}, Edge{2, 4}, Edge{2, 9}, Edge{4, 7},
                                       Edge{4, 9}, Edge{7, 9}));
  for (const auto& sides : found.of_triangle) EXPECT_EQ(sides[0], 5u);
}

TEST(MeshEdges, TriangleThatNamesAVertexTwiceHasOneEdge) {
  const std::vector<Triangle> triangles = {{5, 5, 3}, {3, 5, 5}, {5, 3, 5}};
  const MeshEdges found = mesh_edges(triangles);
  EXPECT_THAT(found.edges, ElementsAre(Edge{3, 5}));
  using Sides = std::array<std::uint32_t, 3>;
  EXPECT_THAT(found.of_triangle,
              ElementsAre(Sides{kNone, 0, 0}, Sides{0, kNone, 0}, Sides{0, 0, kNone}));
}

TEST(MeshEdges, TriangleOfOneVertexHasNone) {
  const MeshEdges found = mesh_edges(std::vector<Triangle>{{8, 8, 8}});
  EXPECT_THAT(found.edges, IsEmpty());
  EXPECT_EQ(found.of_triangle.at(0), (std::array{kNone, kNone, kNone}));
  EXPECT_THAT(mesh_edges({}).edges, IsEmpty());
  EXPECT_THAT(mesh_edges({}).of_triangle, IsEmpty());
}

TEST(MeshEdges, ClosedMeshHasThreeForEveryTwoTriangles) {
  for (const TriangleMesh& mesh : {test::unit_box_mesh(3), test::sphere_mesh(Vec3::Zero(), 1, 2)}) {
    const MeshEdges found = mesh_edges(mesh.triangles);
    EXPECT_EQ(2 * found.edges.size(), 3 * mesh.triangles.size());
    EXPECT_EQ(fault(mesh.triangles, found), "");
  }
}

TEST(MeshEdges, RandomMeshesAgreeWithBruteForce) {
  test::TriangleSource random(801);
  std::size_t shared = 0, none = 0;
  for (int round = 0; round < 300; ++round) {
    const int vertices = 1 + random.below(40);
    std::vector<Triangle> triangles(static_cast<std::size_t>(random.below(60)));
    for (Triangle& t : triangles)
      for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(random.below(vertices));
    const MeshEdges found = mesh_edges(triangles);
    ASSERT_EQ(fault(triangles, found), "") << "round " << round;
    for (const auto& sides : found.of_triangle)
      none += static_cast<std::size_t>(std::count(sides.begin(), sides.end(), kNone));
    shared += 3 * triangles.size() - found.edges.size();
  }
  EXPECT_GT(none, 1000u);
  EXPECT_GT(shared, 5000u);
}

}  // namespace
}  // namespace contactcheck
