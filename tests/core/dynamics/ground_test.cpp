#include "core/dynamics/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

// The definition: every vertex mapped, every one compared.
std::vector<std::uint32_t> held_by_mapping_all(const BodyShape& shape,
                                               const std::vector<Vec3>& nodes,
                                               const Ground& ground) {
  std::vector<Vec3> vertices(shape.mesh.vertices.size());
  map_body(shape, nodes, vertices);
  std::vector<std::uint32_t> held;
  for (std::uint32_t v = 0; v < vertices.size(); ++v)
    if (vertices[v][ground.axis] <= ground.height) held.push_back(v);
  return held;
}

double lowest_vertex(const BodyShape& shape, const std::vector<Vec3>& nodes, int axis) {
  std::vector<Vec3> vertices(shape.mesh.vertices.size());
  map_body(shape, nodes, vertices);
  double lowest = vertices[0][axis];
  for (const Vec3& v : vertices) lowest = std::min(lowest, v[axis]);
  return lowest;
}

TEST(Ground, HoldsTheVerticesThatMappingAllOfThemFinds) {
  const auto shape = make_shape(test::sphere_mesh({5, 5, 5}, 1.0, 3), {4, 5, 3});
  test::TriangleSource random(76);
  std::size_t held = 0, free = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<Vec3> nodes = test::rest_nodes_at(*shape, Vec3::Zero());
    for (Vec3& n : nodes) n = random.point(n, 0.3);
    Ground ground;
    ground.axis = round % 3;
    ground.height = 5.0 + 1.4 * random.unit();
    const auto found = vertices_in_ground(*shape, nodes, ground);
    EXPECT_EQ(found, held_by_mapping_all(*shape, nodes, ground));
    held += found.size();
    free += shape->mesh.vertices.size() - found.size();
  }
  EXPECT_GT(held, 10'000u);
  EXPECT_GT(free, 10'000u);
}

TEST(Ground, HoldsAVertexOnItAndNoneAboveIt) {
  const auto shape = make_shape(test::sphere_mesh({0.1, 0.2, 0.3}, 1.0, 2), {3, 3, 3});
  const std::vector<Vec3> nodes = test::rest_nodes_at(*shape, {0.01, 0.02, 0.03});
  Ground ground;
  ground.height = lowest_vertex(*shape, nodes, ground.axis);
  EXPECT_EQ(vertices_in_ground(*shape, nodes, ground).size(), 1u);
  ground.height = std::nextafter(ground.height, -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(vertices_in_ground(*shape, nodes, ground).empty());
}

// All nodes at one height: mapping rounds some vertices below every node of their cell.
TEST(Ground, HoldsAVertexThatMappingRoundsBelowItsNodes) {
  const auto shape = make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 3), {4, 4, 4});
  test::TriangleSource random(77);
  std::size_t rounded_below = 0;
  for (int round = 0; round < 100; ++round) {
    std::vector<Vec3> nodes = test::rest_nodes_at(*shape, Vec3::Zero());
    const double level = 3.0 * random.unit();
    for (Vec3& n : nodes) n.y() = level;
    Ground ground;
    ground.height = lowest_vertex(*shape, nodes, 1);
    if (ground.height < level) ++rounded_below;
    EXPECT_EQ(vertices_in_ground(*shape, nodes, ground),
              held_by_mapping_all(*shape, nodes, ground));
  }
  EXPECT_GT(rounded_below, 50u);
}

TEST(Ground, HoldsVerticesOfABareBody) {
  const auto shape = make_bare_shape(test::unit_box_mesh(2));
  Ground ground;
  ground.axis = 2;
  ground.height = 0.5;
  const std::vector<Vec3> nodes = test::rest_nodes_at(*shape, Vec3::Zero());
  const auto held = vertices_in_ground(*shape, nodes, ground);
  EXPECT_EQ(held, held_by_mapping_all(*shape, nodes, ground));
  EXPECT_EQ(held.size(), 17u);  // 9 at z = 0, 8 round the middle
}

}  // namespace
}  // namespace contactcheck
