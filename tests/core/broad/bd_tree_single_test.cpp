// BD-trees of floats: their spheres hold the vertices as they are mapped in floats.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/deform/mapping.h"
#include "core/types/local_origin.h"
#include "tests/core/broad/bd_deformations.h"

namespace contactcheck {
namespace {

using test::deformed;
using test::kNodeCases;
using test::NodeCase;
using test::sphere_body;
using test::TriangleSource;

std::vector<Vec3f> in_floats(const std::vector<Vec3>& nodes) {
  std::vector<Vec3f> out(nodes.size());
  round_to_local(nodes, Vec3::Zero(), out);
  return out;
}

std::vector<Vec3> in_doubles(const std::vector<Vec3f>& nodes) {
  std::vector<Vec3> out;
  for (const Vec3f& n : nodes) out.push_back(n.cast<double>());
  return out;
}

/// Nodes are rounded first.
std::string broken_in_floats(const Body& body, const std::vector<Vec3>& exact) {
  return test::broken<float>(body, in_doubles(in_floats(exact)));
}

TEST(BdTreeSpheres, OfFloatsHoldVerticesMappedInFloats) {
  const Body body = sphere_body();
  const std::vector<Vec3> rest = test::rest_nodes_at(*body.shape, Vec3::Zero());
  int within = 0;
  for (const NodeCase& c : kNodeCases) {
    for (std::uint64_t seed : {1, 2, 3}) {
      const std::vector<Vec3> nodes = deformed(c, rest, seed);
      double largest = 0.0;
      for (const Vec3& n : nodes) largest = std::max(largest, n.cwiseAbs().maxCoeff());
      if (largest > kSingleLimit) continue;
      ++within;
      EXPECT_EQ(broken_in_floats(body, nodes), "") << c.name;
    }
  }
  EXPECT_GE(within, 36) << "12 of the cases lie within the range of floats";
}

TEST(BdTreeSpheres, OfFloatsHoldTheirVerticesOfAnySize) {
  for (double scale : {1e-50, 1e-44, 1e-38, 1e-19, 1e-9, 1.0, 1e9, 1e12}) {
    const Body body = sphere_body(scale);
    TriangleSource random(11);
    std::vector<Vec3> nodes = test::rest_nodes_at(*body.shape, Vec3::Zero());
    EXPECT_EQ(broken_in_floats(body, nodes), "") << scale;
    for (Vec3& n : nodes) n = random.point(n, 0.03 * scale);
    EXPECT_EQ(broken_in_floats(body, nodes), "") << scale;
  }
}

// One triangle that is a point, mapped in floats: all that its sphere has to hold is rounding.
TEST(BdTreeSpheres, OfFloatsPayForTheRoundingOfVertices) {
  TriangleSource random(12);
  double farthest = 0.0;
  for (int round = 0; round < 300; ++round) {
    const Vec3 at = random.point(Vec3::Zero(), 0.3);
    std::array<std::vector<double>, 3> lines;
    lines.fill({-0.52, 0.52});
    const Body body{"", make_shape_on_lines(test::triangle_mesh(at, at, at), lines)};
    BdTreeOf<float> tree(make_bd_model(*body.shape, 1), {});
    std::vector<Vec3> nodes = test::rest_nodes_at(*body.shape, Vec3::Zero());
    for (Vec3& node : nodes) node = random.point(node, 0.2);
    nodes = in_doubles(in_floats(nodes));
    tree.begin_frame(nodes);
    EXPECT_EQ(tree.validate(), "");
    const Vec3 off = (tree.vertex(2) - tree.sphere(0).center).cast<double>();
    farthest = std::max(farthest, off.norm());
  }
  EXPECT_GT(farthest, 0x1p-25) << "nothing was rounded";
}

TEST(BdTree, MapsVerticesInFloatsWithTheBitsOfTheBatch) {
  const Body body = sphere_body();
  TriangleSource random(10);
  std::vector<Vec3> shaken = test::rest_nodes_at(*body.shape, Vec3::Zero());
  for (Vec3& n : shaken) n = random.point(n, 0.4);
  const std::vector<Vec3f> floats = in_floats(shaken);
  const std::vector<Vec3> nodes = in_doubles(floats);
  BdTreeOf<float> tree(make_bd_model(*body.shape, 4), {});
  tree.begin_frame(nodes);
  const Embedding& embedding = body.shape->embedding;
  std::vector<Vec3f> expected(body.shape->mesh.vertices.size());
  map_vertices(*body.shape->lattice, embedding, single_local(embedding), floats, expected);
  for (std::uint32_t v = 0; v < expected.size(); ++v) EXPECT_EQ(tree.vertex(v), expected[v]);
}

}  // namespace
}  // namespace contactcheck
