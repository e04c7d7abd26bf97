// The spheres of BD-trees hold their vertices whatever the lattice does, and the parts they are
// made of keep what their headers promise.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/broad/bd_deformations.h"

namespace contactcheck {
namespace {

using test::deformed;
using test::kNodeCases;
using test::NodeCase;
using test::sphere_body;
using test::TriangleSource;

std::string broken(const Body& body, const std::vector<Vec3>& nodes) {
  return test::broken<double>(body, nodes);
}

TEST(BdTreeSpheres, HoldTheirVerticesHoweverTheLatticeIsDeformed) {
  const Body body = sphere_body();
  const std::vector<Vec3> rest = test::rest_nodes_at(*body.shape, Vec3::Zero());
  for (const NodeCase& c : kNodeCases) {
    for (std::uint64_t seed : {1, 2, 3}) {
      const std::vector<Vec3> nodes = deformed(c, rest, seed);
      EXPECT_EQ(broken(body, nodes), "") << c.name;
    }
  }
}

TEST(BdTreeSpheres, HoldTheirVerticesWhereTheBodyRestsFarOutOrIsTiny) {
  for (const auto& [scale, at] :
       {std::pair(1.0, Vec3(1e8, -1e8, 3)), std::pair(1e-3, Vec3(1e6, 0, 0)),
        std::pair(1e-100, Vec3(0, 0, 0)), std::pair(1e-200, Vec3(0, 0, 0)),
        std::pair(1e200, Vec3(0, 0, 0)), std::pair(1e307, Vec3(0, 0, 0))}) {
    const Body body = sphere_body(scale, at);
    TriangleSource random(7);
    std::vector<Vec3> nodes = test::rest_nodes_at(*body.shape, Vec3::Zero());
    EXPECT_EQ(broken(body, nodes), "") << scale;
    for (Vec3& n : nodes) n = random.point(n, 0.3 * scale);
    EXPECT_EQ(broken(body, nodes), "") << scale;
    for (Vec3& n : nodes) n -= at;
    EXPECT_EQ(broken(body, nodes), "") << scale;
  }
}

TEST(BdTreeSpheres, ShrunkDoNotHoldThem) {
  const Body body = sphere_body();
  BdSettings settings;
  settings.fault_radius = 0.9;
  BdTree tree(make_bd_model(*body.shape, 4), settings);
  const std::vector<Vec3> nodes = test::rest_nodes_at(*body.shape, Vec3(5, 6, 7));
  tree.begin_frame(nodes);
  EXPECT_NE(tree.validate(), "");
}

// Two vertices at the ends of the diagonal of one cell, of which one corner moves on along it: the
// vertex there goes (the cell's padding aside) as far as the bound allows. (Counting largest
// components instead of lengths, as a published implementation does, gives a third of the
// displacement away.)
TEST(BdTreeSpheres, TheBoundIsAttained) {
  const TriangleMesh diagonal = test::triangle_mesh(Vec3::Zero(), Vec3::Ones(), Vec3::Ones());
  const Body body = test::make_body("", diagonal, {1, 1, 1}, 0.0);
  std::vector<Vec3> nodes = test::rest_nodes_at(*body.shape, Vec3::Zero());
  nodes.back() += Vec3::Ones();  // the far corner of the only cell
  BdTree tree(make_bd_model(*body.shape, 1), {1, ReferenceKind::kNone, true});
  tree.begin_frame(nodes);
  EXPECT_EQ(tree.validate(), "");
  double farthest = 0.0;
  for (std::uint32_t v = 0; v < 3; ++v)
    farthest = std::max(farthest, (tree.vertex(v) - tree.sphere(0).center).norm());
  EXPECT_GT(tree.sphere(0).radius, farthest);
  EXPECT_LT(tree.sphere(0).radius, 1.02 * farthest);
}

TEST(BdTreeSpheres, StayAsAtRestUnderARigidMotion) {
  const Body body = sphere_body();
  const auto model = make_bd_model(*body.shape, 4);
  const Eigen::AngleAxisd turn(1.1, Vec3(1, 2, -1).normalized());
  std::vector<Vec3> nodes = test::rest_nodes_at(*body.shape, Vec3::Zero());
  for (Vec3& n : nodes) n = turn * n + Vec3(30, -4, 9);
  for (ReferenceKind kind : {ReferenceKind::kAffine, ReferenceKind::kRigid}) {
    BdTree tree(model, {4, kind, true});
    tree.begin_frame(nodes);
    for (std::uint32_t n = 0; n < model->spheres.size(); ++n)
      EXPECT_LT(tree.sphere(n).radius, 1.003 * model->spheres[n].rest_radius);
  }
}

TEST(BdTreeSpheres, RootRadiusAtRestIsNearlyThatOfTheBody) {
  const auto model = make_bd_model(*sphere_body().shape, 4);
  EXPECT_GE(model->spheres[0].rest_radius, 1.0);
  EXPECT_LT(model->spheres[0].rest_radius, 1.15);
}

TEST(BdTree, MapsVerticesWithTheCanonicalBits) {
  const Body body = sphere_body();
  TriangleSource random(9);
  BdTree tree(make_bd_model(*body.shape, 4), {});
  for (int frame = 0; frame < 3; ++frame) {
    std::vector<Vec3> nodes = test::rest_nodes_at(*body.shape, Vec3::Zero());
    for (Vec3& n : nodes) n = random.point(n, 0.4);
    tree.begin_frame(nodes);
    const test::FrameData mapped = test::make_frame({body}, {nodes});
    for (std::uint32_t v = 0; v < mapped.vertices[0].size(); ++v)
      EXPECT_EQ(tree.vertex(v), mapped.vertices[0][v]);
    EXPECT_EQ(tree.mapped_vertices(), mapped.vertices[0].size());
    tree.vertex(0);
    EXPECT_EQ(tree.mapped_vertices(), mapped.vertices[0].size());
  }
}

TEST(BdTree, ComputesASphereOncePerFrame) {
  const Body body = sphere_body();
  BdTree tree(make_bd_model(*body.shape, 4), {});
  const std::vector<Vec3> here = test::rest_nodes_at(*body.shape, Vec3::Zero());
  const std::vector<Vec3> there = test::rest_nodes_at(*body.shape, Vec3(8, 0, 0));
  tree.begin_frame(here);
  const Vec3 first = tree.sphere(3).center;
  tree.sphere(3);
  EXPECT_EQ(tree.evaluated_spheres(), 1u);
  EXPECT_EQ(tree.mapped_vertices(), 0u);
  tree.begin_frame(there);
  EXPECT_EQ(tree.evaluated_spheres(), 0u);
  EXPECT_NEAR((tree.sphere(3).center - first).x(), 8.0, 1e-12);
}

// Far out, a mesh at rest is known to 1e-8 only, while its deformed lattice may be small and near.
// On a line, with the farthest vertices at the ends of it, that is all there is to spare.
TEST(BdTreeSpheres, PayForTheRoundingOfRestPositions) {
  TriangleSource random(8);
  for (int round = 0; round < 50; ++round) {
    const Vec3 at = random.point(Vec3::Zero(), 1e8);
    const Body body = test::make_body(
        "", test::triangle_mesh(at, at + Vec3::Ones(), at + Vec3::Ones()), {2, 2, 2});
    std::vector<Vec3> nodes = test::rest_nodes_at(*body.shape, Vec3::Zero());
    for (Vec3& n : nodes) n = Vec3::Constant((n - at).sum() / 3.0);
    EXPECT_EQ(broken(body, nodes), "") << round;
  }
}

TEST(BdModel, CornerWeightsSumToOneAndPickTheCorners) {
  EXPECT_EQ(corner_weights(Vec3(0.5, 0.25, 0.125)),
            (std::array<double, 8>{0.328125, 0.328125, 0.109375, 0.109375, 0.046875, 0.046875,
                                   0.015625, 0.015625}));
  for (int c = 0; c < 8; ++c)
    for (int other = 0; other < 8; ++other)
      EXPECT_EQ(corner_weights(Vec3(c & 1, c >> 1 & 1, c >> 2))[other], c == other ? 1.0 : 0.0);
}

TEST(BdModel, CentreWeightsSumToOneExactlyAndSpreadsHoldEveryVertex) {
  const Body body = sphere_body();
  const auto model = make_bd_model(*body.shape, 4);
  const Lattice& lattice = *body.shape->lattice;
  for (std::uint32_t n = 0; n < model->spheres.size(); ++n) {
    double sum = 0.0;
    for (const BdInfluence& i : model->influences_of(n)) {
      sum += i.weight;
      EXPECT_EQ(std::ldexp(i.weight, 50), std::floor(std::ldexp(i.weight, 50)));
      EXPECT_GE(i.weight, 0.0);
      EXPECT_LE(i.spread, 1.0 + 0x1p-40);
    }
    EXPECT_EQ(sum, 1.0);
    const TriangleTree::Node node = model->tree.nodes[n];
    for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot)  // of leaves
      for (std::uint32_t v : model->tree.corners[slot]) {
        // In more than double: spreads have the rounding of weights in them.
        std::vector<long double> weights(lattice.nodes.size(), 0.0L);
        const auto& corners = lattice.cell_nodes[body.shape->embedding.home_cell[v]];
        const Vec3& local = body.shape->embedding.local[v];
        for (int c = 0; c < 8; ++c) {
          weights[corners[c]] = 1.0L;
          for (int k = 0; k < 3; ++k)
            weights[corners[c]] *= c >> k & 1 ? local[k] : 1.0L - local[k];
        }
        for (const BdInfluence& i : model->influences_of(n)) {
          EXPECT_LE(std::abs(weights[i.node] - i.weight), i.spread);
          weights[i.node] = 0.0L;
        }
        for (long double left : weights) EXPECT_EQ(left, 0.0L);  // every node it hangs on is listed
      }
  }
}

}  // namespace
}  // namespace contactcheck
