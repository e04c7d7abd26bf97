// Bounds in single precision: those from nodes hold the vertices that are mapped in floats, those
// from vertices are made of them.

#include <gtest/gtest.h>

#include "core/types/check.h"
#include "tests/core/lazy/bounds_cases.h"

namespace contactcheck {
namespace {

using test::AllKernels;
using test::Deformation;
using test::lanes_of;
using test::NamedShape;
using test::OneBody;
using test::reported_lanes;
using test::shapes;
using test::TriangleSource;

constexpr Precision kSingle = Precision::kSingle;

TEST(SingleBounds, HoldTheirVerticesUnderStrongDeformation) {
  TriangleSource random(521);
  for (const NamedShape& named : shapes()) {
    AllKernels kernels(named.shape, kSingle);
    for (double strength : {0.0, 0.3, 2.0, 50.0})  // cells are turned inside out
      for (double scale : {1e-40, 1e-30, 1e-9, 1.0, 1e9})
        for (double offset : {0.0, 1e6, -1e12}) {  // where little of the shape is left, too
          const Deformation how{strength, scale, Vec3(offset, -offset, 0.5 * offset)};
          EXPECT_EQ(kernels.broken(deformed_nodes(*named.shape, how, random)), "")
              << named.name << " " << strength << " " << scale << " " << offset;
        }
  }
}

TEST(SingleBounds, HoldTheirVerticesAtTheEndsOfFloats) {
  TriangleSource random(522);
  for (const NamedShape& named : shapes()) {
    AllKernels kernels(named.shape, kSingle);
    for (double scale : {0x1p-1074, 0x1p-160, 0x1p-149, 0x1p-140, 0x1p-126, 0x1p38})
      EXPECT_EQ(kernels.broken(deformed_nodes(*named.shape, {0.3, scale}, random)), "")
          << named.name << " " << scale;
  }
}

TEST(SingleBounds, HoldBesideAMuchLargerBody) {
  TriangleSource random(523);
  for (const NamedShape& named : shapes()) {
    AllKernels kernels(named.shape, kSingle);
    for (double size : {1e-30, 1.0})
      for (double company : {10.0, 1e3, 1e7, 1e11})
        EXPECT_EQ(kernels.broken(deformed_nodes(*named.shape, {1.0, size}, random), company * size),
                  "")
            << named.name << " " << size << " " << company;
  }
}

TEST(SingleBounds, HoldWhenTheLatticeIsFlattenedOrCollapsed) {
  TriangleSource random(524);
  for (const NamedShape& named : shapes()) {
    AllKernels kernels(named.shape, kSingle);
    for (double squeeze : {0.0, 0x1p-140, 1e-20, -1.0})
      for (const Vec3& axes :
           {Vec3(1, 1, squeeze), Vec3(squeeze, 1, squeeze), Vec3(squeeze, squeeze, squeeze)}) {
        std::vector<Vec3> nodes = deformed_nodes(*named.shape, {0.3}, random);
        for (Vec3& n : nodes) n = n.cwiseProduct(axes) + Vec3(0, 3e5, 0);
        EXPECT_EQ(kernels.broken(nodes), "") << named.name << " " << axes.transpose();
      }
  }
}

TEST(SingleBounds, HoldWhenOneNodeIsFarAway) {
  TriangleSource random(525);
  for (const NamedShape& named : shapes()) {
    AllKernels kernels(named.shape, kSingle);
    for (double distance : {10.0, 1e6, -1e11})
      for (int round = 0; round < 4; ++round) {
        std::vector<Vec3> nodes = deformed_nodes(*named.shape, {0.2}, random);
        const int node = random.below(static_cast<int>(nodes.size()));
        nodes[static_cast<std::size_t>(node)] += random.point(Vec3::Zero(), distance);
        EXPECT_EQ(kernels.broken(nodes), "") << named.name << " " << distance << " " << node;
      }
  }
}

TEST(SingleBounds, ShrunkOrMovedByOnePercentAreReported) {
  TriangleSource random(526);
  for (bool from_vertices : {false, true})
    for (const std::string& isa : lazy_isas()) {
      OneBody body(shapes()[4].shape, from_vertices, kSingle);
      body.begin(deformed_nodes(body.shape(), {0.0, 1.0, Vec3(3e6, 4, 5)}, random));
      ASSERT_EQ(body.broken(lazy_kernels(isa)), "");
      const int lanes = lanes_of(body.tree());
      EXPECT_GE(lanes, 8);
      EXPECT_EQ(reported_lanes(body, test::shrink), lanes) << isa;
      EXPECT_EQ(reported_lanes(body, test::move_up), lanes) << isa;
      EXPECT_EQ(reported_lanes(body, test::move_down), lanes) << isa;
    }
}

// Nothing is rounded between the floats that are tested and their boxes.
TEST(SingleBounds, OfRefittedBodiesAreTheBoxesOfTheirVertices) {
  TriangleSource random(527);
  for (const NamedShape& named : shapes())
    for (const std::string& isa : lazy_isas()) {
      OneBody body(named.shape, true, kSingle);
      body.begin(deformed_nodes(body.shape(), {0.3, 1.0, Vec3(1e6, 0, 0)}, random));
      ASSERT_EQ(body.broken(lazy_kernels(isa)), "");
      for (std::uint32_t b = 0; b < body.tree().blocks.size(); ++b)
        for (std::uint32_t c = 0; c < body.tree().blocks[b].children; ++c) {
          const Aabb truth =
              body.box_of(test::triangles_under(body.tree(), body.tree().blocks[b].child[c]));
          const LaneBoxes& boxes = body.state().blocks.find(b)->box;
          for (int k = 0; k < 3; ++k) {
            ASSERT_EQ(static_cast<double>(boxes.lo[k][c]), truth.lo[k]) << named.name << isa;
            ASSERT_EQ(static_cast<double>(boxes.hi[k][c]), truth.hi[k]) << named.name << isa;
          }
        }
    }
}

// Of a face whose nodes agree in one coordinate, rounding takes vertices to both of its sides.
TEST(SingleBounds, OfTheWholeBodyHoldVerticesOutsideTheHullOfTheNodes) {
  TriangleSource random(529);
  const std::vector<double> line = {0, 1, 2};
  OneBody body(
      make_shape_on_lines(test::box_mesh(Vec3::Zero(), Vec3::Constant(2), 14), {line, line, line}),
      false, kSingle);
  int outside = 0;
  for (double scale : {0.1, 0.7, 1.0 / 3.0}) {
    body.begin(deformed_nodes(body.shape(), {0.0, scale}, random));
    AabbOf<float> hull;
    for (const Vec3f& node : body.state().single.nodes) hull.extend(node);
    for (const Vec3f& v : body.single_vertices()) {
      outside += !hull.contains(v);
      EXPECT_TRUE(body.state().box.contains(v.cast<double>())) << scale;
    }
  }
  EXPECT_GT(outside, 0);
}

TEST(SingleBounds, AreRefusedBeyondTheLimit) {
  TriangleSource random(528);
  OneBody body(shapes()[1].shape, false, kSingle);
  EXPECT_NO_THROW(body.begin(deformed_nodes(body.shape(), {0.0, 5e11}, random)));
  EXPECT_THROW(body.begin(deformed_nodes(body.shape(), {0.0, 2e12}, random)), RefusedInput);
  EXPECT_THROW(body.begin(deformed_nodes(body.shape(), {0.0, 1e300}, random)), RefusedInput);
}

}  // namespace
}  // namespace contactcheck
