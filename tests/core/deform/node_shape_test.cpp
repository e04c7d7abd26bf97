// Bodies whose vertices are lattice nodes: any positions come through to the bit.

#include "core/deform/node_shape.h"

#include <gtest/gtest.h>

#include "core/types/check.h"
#include "tests/support/random_triangles.h"

namespace contactcheck {
namespace {

std::vector<Triangle> strip(std::size_t vertices) {
  std::vector<Triangle> out;
  for (std::uint32_t v = 0; v + 2 < vertices; ++v) out.push_back({v, v + 1, v + 2});
  return out;
}

TEST(NodeShape, ReproducesAnyVerticesToTheBit) {
  test::TriangleSource random(71);
  for (std::size_t count : {3, 4, 8, 9, 27, 28, 100})
    for (double size : {0x1p-1074, 1e-300, 1.0, 1e300}) {
      const NodeShape body = make_node_shape(count, strip(count));
      std::vector<Vec3> wanted, mapped(count);
      for (std::size_t v = 0; v < count; ++v)
        wanted.push_back(size * random.point(Vec3::Zero(), 1.0));
      const std::vector<Vec3> nodes = body.nodes_for(wanted);
      ASSERT_EQ(nodes.size(), body.shape->node_count());
      map_body(*body.shape, nodes, mapped);
      for (std::size_t v = 0; v < count; ++v) EXPECT_EQ(mapped[v], wanted[v]) << count << " " << v;
    }
}

TEST(NodeShape, FillsABoxAlongEveryAxis) {
  for (std::size_t count : {3, 5, 8, 20}) {
    const NodeShape body = make_node_shape(count, strip(count));
    EXPECT_GT(bounding_box(body.shape->mesh.vertices).extent().minCoeff(), 0.0) << count;
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = 0; b < a; ++b)
        EXPECT_NE(body.shape->mesh.vertices[a], body.shape->mesh.vertices[b]);
  }
}

TEST(NodeShape, RefusesWhatCannotBeAMesh) {
  EXPECT_THROW(make_node_shape(3, {{0, 1, 3}}), InputError);
  EXPECT_THROW(make_node_shape(3, {}), InputError);
}

}  // namespace
}  // namespace contactcheck
