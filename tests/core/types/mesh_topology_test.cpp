#include "core/types/mesh_topology.h"

#include <gmock/gmock.h>

#include <limits>

#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<std::uint32_t> indices(const MeshTopology& topology, MeshDefectKind kind) {
  std::vector<std::uint32_t> out;
  for (const MeshDefect& d : topology.defects)
    if (d.kind == kind) out.push_back(d.index);
  return out;
}

TEST(MeshTopology, ClosedSurfacesAreSolid) {
  for (const TriangleMesh& mesh :
       {test::unit_box_mesh(1), test::unit_box_mesh(3), test::sphere_mesh({1, 2, 3}, 2.0, 3)}) {
    const MeshTopology topology = analyse_topology(mesh);
    EXPECT_THAT(topology.defects, IsEmpty());
    EXPECT_TRUE(topology.solid);
    EXPECT_FALSE(topology.fatal);
    EXPECT_EQ(describe(topology), "");
  }
}

TEST(MeshTopology, SupportMeshesAreOrientedOutward) {
  for (const TriangleMesh& mesh : {test::unit_box_mesh(3), test::sphere_mesh({1, 2, 3}, 2.0, 2)}) {
    double volume = 0.0;
    for (const Triangle& t : mesh.triangles)
      volume += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6.0;
    EXPECT_GT(volume, 0.9);
  }
}

TEST(MeshTopology, MissingTriangleLeavesThreeBoundaryEdges) {
  TriangleMesh mesh = test::unit_box_mesh(1);
  mesh.triangles.erase(mesh.triangles.begin() + 4);
  const MeshTopology topology = analyse_topology(mesh);
  EXPECT_EQ(topology.count(MeshDefectKind::kBoundaryEdge), 3u);
  EXPECT_EQ(topology.defects.size(), 3u);
  EXPECT_FALSE(topology.solid);
  EXPECT_FALSE(topology.fatal);
}

TEST(MeshTopology, DefectsOfOneKindAreInOrderOfIndex) {
  TriangleMesh mesh = test::unit_box_mesh(2);
  // The highest vertices first: edges in order of vertices are not in order of triangles.
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(mesh.vertices.size()) - 1 - v;
  mesh.triangles.resize(mesh.triangles.size() - 10);
  const auto open = indices(analyse_topology(mesh), MeshDefectKind::kBoundaryEdge);
  ASSERT_GE(open.size(), 3u);
  EXPECT_TRUE(std::is_sorted(open.begin(), open.end()));
}

TEST(MeshTopology, ThirdTriangleOnAnEdgeIsNonManifold) {
  TriangleMesh mesh = test::unit_box_mesh(1);
  mesh.vertices.push_back({5, 5, 5});
  const Triangle t = mesh.triangles[7];
  mesh.triangles.push_back({t[1], t[0], static_cast<std::uint32_t>(mesh.vertices.size() - 1)});
  const MeshTopology topology = analyse_topology(mesh);
  const auto found = indices(topology, MeshDefectKind::kNonManifoldEdge);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LE(found[0], 7u);  // the first triangle of the edge
  EXPECT_FALSE(topology.solid);
}

TEST(MeshTopology, TurnedTriangleIsInconsistentWithItsThreeNeighbours) {
  TriangleMesh mesh = test::sphere_mesh(Vec3::Zero(), 1.0, 1);
  std::swap(mesh.triangles[9][0], mesh.triangles[9][1]);
  const MeshTopology topology = analyse_topology(mesh);
  EXPECT_EQ(topology.count(MeshDefectKind::kInconsistentOrientation), 3u);
  EXPECT_EQ(topology.count(MeshDefectKind::kBoundaryEdge), 0u);
  EXPECT_FALSE(topology.solid);
}

TEST(MeshTopology, RepeatedIndexIsNamed) {
  TriangleMesh mesh = test::unit_box_mesh(1);
  mesh.triangles.push_back({3, 6, 3});
  const MeshTopology topology = analyse_topology(mesh);
  EXPECT_THAT(indices(topology, MeshDefectKind::kRepeatedIndex), ElementsAre(12u));
  EXPECT_EQ(topology.defects.size(), 1u);  // its edges are no defects of their own
  EXPECT_FALSE(topology.solid);
}

TEST(MeshTopology, CollinearCornersAreZeroAreaAndStayUsable) {
  TriangleMesh mesh = test::unit_box_mesh(1);
  mesh.vertices.insert(mesh.vertices.end(), {{9, 9, 9}, {10, 9, 9}, {12, 9, 9}, {9, 9, 9}});
  mesh.triangles.push_back({8, 9, 10});
  mesh.triangles.push_back({8, 9, 11});
  const MeshTopology topology = analyse_topology(mesh);
  EXPECT_THAT(indices(topology, MeshDefectKind::kZeroAreaTriangle), ElementsAre(12u, 13u));
  EXPECT_FALSE(topology.fatal);
}

TEST(MeshTopology, DuplicatesAreNamedInAnyOrderOfTheirCorners) {
  TriangleMesh mesh = test::unit_box_mesh(1);
  const Triangle first = mesh.triangles[4];
  mesh.triangles.push_back({first[1], first[2], first[0]});
  mesh.triangles.push_back({first[1], first[0], first[2]});
  const MeshTopology topology = analyse_topology(mesh);
  EXPECT_THAT(indices(topology, MeshDefectKind::kDuplicateTriangle), ElementsAre(12u, 13u));
  EXPECT_THAT(describe(topology), testing::StartsWith("2 duplicate-triangle (first: triangle 12)"));
  EXPECT_FALSE(topology.fatal);
}

TEST(MeshTopology, AreaIsSeenAtEveryScale) {
  for (double scale : {0x1p-1000, 0x1p-600, 1.0, 0x1p600, 0x1p1000}) {
    TriangleMesh mesh = test::sphere_mesh(Vec3::Zero(), 1.0, 1);
    for (Vec3& v : mesh.vertices) v *= scale;
    EXPECT_TRUE(analyse_topology(mesh).solid) << scale;
    EXPECT_THAT(analyse_topology(mesh).defects, IsEmpty()) << scale;
  }
}

TEST(MeshTopology, NonFiniteVertexIsFatal) {
  for (double bad : {kNaN, kInfinity, -kInfinity}) {
    TriangleMesh mesh = test::unit_box_mesh(1);
    mesh.vertices[6].z() = bad;
    const MeshTopology topology = analyse_topology(mesh);
    EXPECT_THAT(indices(topology, MeshDefectKind::kNonFiniteVertex), ElementsAre(6u));
    EXPECT_TRUE(topology.fatal);
    EXPECT_FALSE(topology.solid);
  }
}

TEST(MeshTopology, IndexOutOfRangeIsFatalAndNamedOncePerTriangle) {
  TriangleMesh mesh = test::unit_box_mesh(1);
  mesh.triangles[2] = {8, 9, 0};
  mesh.triangles[5][1] = ~0u;
  const MeshTopology topology = analyse_topology(mesh);
  EXPECT_THAT(indices(topology, MeshDefectKind::kIndexOutOfRange), ElementsAre(2u, 5u));
  EXPECT_TRUE(topology.fatal);
}

TEST(MeshTopology, EmptyIsFatal) {
  TriangleMesh only_vertices = test::unit_box_mesh(1);
  only_vertices.triangles.clear();
  for (const TriangleMesh& mesh : {TriangleMesh{}, only_vertices}) {
    const MeshTopology topology = analyse_topology(mesh);
    EXPECT_EQ(topology.count(MeshDefectKind::kEmpty), 1u);
    EXPECT_TRUE(topology.fatal);
    EXPECT_EQ(describe(topology), "1 empty-mesh");
  }
}

TEST(MeshTopology, FatalIsExactlyWhatNoDetectorCanBeGiven) {
  for (MeshDefectKind kind :
       {MeshDefectKind::kEmpty, MeshDefectKind::kNonFiniteVertex, MeshDefectKind::kIndexOutOfRange})
    EXPECT_TRUE(is_fatal(kind)) << name_of(kind);
  for (MeshDefectKind kind :
       {MeshDefectKind::kRepeatedIndex, MeshDefectKind::kZeroAreaTriangle,
        MeshDefectKind::kDuplicateTriangle, MeshDefectKind::kNonManifoldEdge,
        MeshDefectKind::kBoundaryEdge, MeshDefectKind::kInconsistentOrientation})
    EXPECT_FALSE(is_fatal(kind)) << name_of(kind);
}

TEST(MeshTopology, SeveralComponentsAndALoneVertexAreSolid) {
  TriangleMesh mesh = test::unit_box_mesh(1);
  mesh.vertices.push_back({7, 7, 7});  // 8: without a triangle
  for (const Vec3& v : test::unit_box_mesh(1).vertices) mesh.vertices.push_back(v + Vec3(5, 0, 0));
  for (int t = 0; t < 12; ++t) {
    Triangle moved = mesh.triangles[t];
    for (std::uint32_t& v : moved) v += 9;
    mesh.triangles.push_back(moved);
  }
  const MeshTopology topology = analyse_topology(mesh);
  EXPECT_TRUE(topology.solid);
}

TEST(MeshTopology, DescribeCountsKindsAndNamesTheFirstIndex) {
  TriangleMesh mesh = test::unit_box_mesh(1);
  mesh.triangles.pop_back();
  mesh.triangles.push_back({0, 0, 1});
  const std::string text = describe(analyse_topology(mesh));
  EXPECT_THAT(text, ::testing::StartsWith("1 repeated-index (triangle 11), "));
  EXPECT_THAT(text, ::testing::ContainsRegex("3 boundary-edge \\(first: triangle [0-9]+\\)$"));

  mesh.vertices[1].x() = kNaN;
  mesh.vertices[4].x() = kNaN;
  EXPECT_EQ(describe(analyse_topology(mesh)), "2 non-finite-vertex (first: vertex 1)");
}

TEST(MeshSizeFault, NamesWhatIsBeyondItsLimit) {
  for (const std::uint64_t below : {std::uint64_t{1}, std::uint64_t{0}}) {
    EXPECT_EQ(mesh_size_fault(kMostMeshVertices - below, 1), "");
    EXPECT_EQ(mesh_size_fault(3, kMostMeshTriangles - below), "");
  }
  EXPECT_EQ(mesh_size_fault(kMostMeshVertices + 1, 1),
            "has 2147483648 vertices; at most 2147483647 can be judged");
  EXPECT_EQ(mesh_size_fault(3, kMostMeshTriangles + 1),
            "has 536870913 triangles; at most 536870912 can be judged");
}

}  // namespace
}  // namespace contactcheck
