#include "core/deform/body.h"

#include <gmock/gmock.h>

#include <limits>
#include <utility>

#include "core/types/check.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

std::string error_of(const TriangleMesh& mesh) {
  try {
    make_shape(mesh, {2, 2, 2});
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Body, BareShapeHasItsVerticesAsNodes) {
  const auto shape = make_bare_shape(test::unit_box_mesh(2));
  EXPECT_FALSE(shape->lattice.has_value());
  EXPECT_EQ(shape->node_count(), shape->mesh.vertices.size());
  EXPECT_TRUE(shape->topology.solid);
  std::vector<Vec3> nodes = shape->mesh.vertices, mapped(nodes.size());
  nodes[5] = Vec3(7, 8, 9);
  map_body(*shape, nodes, mapped);
  EXPECT_EQ(mapped, nodes);
}

TEST(Body, EmbeddedShapeHasTheNodesOfItsLattice) {
  const auto shape = make_shape(test::unit_box_mesh(2), {3, 2, 2});
  EXPECT_EQ(shape->node_count(), shape->lattice->nodes.size());
  EXPECT_EQ(shape->embedding.home_cell.size(), shape->mesh.vertices.size());
  std::vector<Vec3> mapped(shape->mesh.vertices.size());
  map_body(*shape, test::rest_nodes_at(*shape, {100, 0, 0}), mapped);
  for (std::size_t v = 0; v < mapped.size(); ++v)
    EXPECT_LT((mapped[v] - shape->mesh.vertices[v] - Vec3(100, 0, 0)).norm(), 1e-13);
}

TEST(Body, MeshWithAFatalDefectIsRefusedByNameAndIndex) {
  TriangleMesh nan = test::unit_box_mesh(1), range = nan;
  nan.vertices[3].x() = std::numeric_limits<double>::quiet_NaN();
  range.triangles[4][2] = 99;
  EXPECT_EQ(error_of(nan), "the mesh cannot be used: 1 non-finite-vertex (vertex 3)");
  EXPECT_EQ(error_of(range), "the mesh cannot be used: 1 index-out-of-range (triangle 4)");
  EXPECT_EQ(error_of({}), "the mesh cannot be used: 1 empty-mesh");
  EXPECT_THROW(make_bare_shape(range), InputError);
}

// The unit box with vertices that no triangle uses before, among and after its own.
TriangleMesh strewn_box() {
  TriangleMesh mesh = test::unit_box_mesh(1);
  mesh.vertices.insert(mesh.vertices.begin() + 3, Vec3(0.5, 0.5, 0.5));
  mesh.vertices.insert(mesh.vertices.begin(), Vec3(-50, 0, 7));
  mesh.vertices.push_back({1e300, 0, 0});
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v += v < 3 ? 1 : 2;
  return mesh;
}

TEST(Body, VertexThatNoTriangleUsesIsNoPartOfIt) {
  const TriangleMesh box = test::unit_box_mesh(1);
  for (const auto& [shape, plain] :
       {std::pair{make_bare_shape(strewn_box()), make_bare_shape(box)},
        std::pair{make_shape(strewn_box(), {3, 2, 4}), make_shape(box, {3, 2, 4})}}) {
    EXPECT_EQ(shape->mesh.vertices, plain->mesh.vertices);
    EXPECT_EQ(shape->mesh.triangles, plain->mesh.triangles);
    EXPECT_EQ(shape->node_count(), plain->node_count());
    EXPECT_EQ(shape->given_vertex_count(), 11u);
    EXPECT_EQ(shape->given.dropped, 3u);
    EXPECT_EQ(shape->given.numbers, (std::vector<std::uint32_t>{1, 2, 3, 5, 6, 7, 8, 9}));
    EXPECT_TRUE(shape->topology.solid);
    EXPECT_EQ(shape->embedding.local, plain->embedding.local);
    if (!plain->lattice) continue;
    EXPECT_EQ(shape->lattice->lines, plain->lattice->lines);
    EXPECT_EQ(shape->lattice->cells, plain->lattice->cells);
  }
}

TEST(Body, DefectsOfVerticesKeepTheirNumbers) {
  TriangleMesh nan = strewn_box();
  nan.vertices[9].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of(nan), "the mesh cannot be used: 1 non-finite-vertex (vertex 9)");
}

TEST(Body, TornWeldNamesVerticesAsTheyWereGiven) {
  TriangleMesh soup = strewn_box();  // the last triangle with corners of its own
  for (std::uint32_t& v : soup.triangles.back()) {
    soup.vertices.push_back(soup.vertices[v]);
    v = static_cast<std::uint32_t>(soup.vertices.size() - 1);
  }
  const auto shape = welded(*make_bare_shape(soup));
  std::vector<Vec3> moved = shape->mesh.vertices;
  EXPECT_EQ(torn_weld(*shape, moved), std::nullopt);
  moved.back().z() += 1.0;
  ASSERT_TRUE(torn_weld(*shape, moved).has_value());
  EXPECT_EQ((*torn_weld(*shape, moved))[1], 13u);
}

TEST(Body, OpenAndDegenerateMeshesAreAccepted) {
  EXPECT_FALSE(
      make_shape(test::triangle_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), {1, 1, 1})->topology.solid);
  const Vec3 p(1, 2, 3);
  EXPECT_EQ(make_shape(test::triangle_mesh(p, p, p), {1, 1, 1})->lattice->cells.size(), 1u);
}

TEST(BodyDeathTest, WrongNumberOfNodesBreaksAPromise) {
  const auto shape = make_shape(test::unit_box_mesh(1), {2, 2, 2});
  std::vector<Vec3> nodes(shape->node_count() - 1), out(shape->mesh.vertices.size());
  EXPECT_DEATH(map_body(*shape, nodes, out), "one position per node");
}

TEST(Body, TriangleUsesItsVerticesAndThoseWeldedToThem) {
  const std::shared_ptr<const BodyShape> open =
      make_bare_shape({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-0.0, 0, 0),
                        Vec3(0, -1, 0), Vec3(-1, 0, 0)},
                       {{0, 1, 2}, {3, 4, 5}}});
  for (const auto& [shape, by_weld] : {std::pair(open, false), std::pair(welded(*open), true)}) {
    EXPECT_TRUE(shape->uses(0, 0) && shape->uses(0, 2) && shape->uses(1, 3));
    EXPECT_FALSE(shape->uses(0, 4) || shape->uses(1, 1));
    EXPECT_EQ(shape->uses(0, 3), by_weld);
    EXPECT_EQ(shape->uses(1, 0), by_weld);
  }
}

}  // namespace
}  // namespace contactcheck
