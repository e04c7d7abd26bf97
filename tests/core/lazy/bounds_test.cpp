// Bounds made from lattice nodes alone, or from vertices: they hold their vertices, whatever the
// deformation, and not much more.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/core/lazy/bounds_cases.h"

namespace contactcheck {
namespace {

using test::AllKernels;
using test::Deformation;
using test::lanes_of;
using test::move_down;
using test::move_up;
using test::NamedShape;
using test::OneBody;
using test::reported_lanes;
using test::rest_nodes_at;
using test::ShapePtr;
using test::shapes;
using test::shrink;
using test::triangles_under;
using test::TriangleSource;

TEST(LazyBounds, HoldTheirVerticesUnderStrongDeformation) {
  TriangleSource random(501);
  for (const NamedShape& named : shapes()) {
    AllKernels kernels(named.shape);
    for (double strength : {0.0, 0.3, 2.0, 50.0})  // cells are turned inside out
      for (double scale : {1e-300, 1e-9, 1.0, 1e9, 1e200})
        for (double offset : {0.0, 1e6, -1e12, 1e300}) {
          const Deformation how{strength, scale, Vec3(offset, -offset, 0.5 * offset)};
          EXPECT_EQ(kernels.broken(deformed_nodes(*named.shape, how, random)), "")
              << named.name << " " << strength << " " << scale << " " << offset;
        }
  }
}

TEST(LazyBounds, HoldTheirVerticesAtTheEndsOfDoubles) {
  TriangleSource random(502);
  for (const NamedShape& named : shapes()) {
    AllKernels kernels(named.shape);
    for (const Deformation& how : {Deformation{0.3, 0x1p-1074}, Deformation{0.3, 1e-310},
                                   Deformation{0.3, 1e306, Vec3(1.6e308, -1.6e308, 0)}})
      EXPECT_EQ(kernels.broken(deformed_nodes(*named.shape, how, random)), "")
          << named.name << " " << how.scale;
  }
}

TEST(LazyBounds, HoldBesideAMuchLargerBody) {
  TriangleSource random(503);
  for (const NamedShape& named : shapes()) {
    AllKernels kernels(named.shape);
    for (double size : {1e-300, 1e-30, 1.0})
      for (double company : {10.0, 1e3, 1e30, 1e290})  // in one frame with the body, then not
        EXPECT_EQ(kernels.broken(deformed_nodes(*named.shape, {1.0, size}, random), company * size),
                  "")
            << named.name << " " << size << " " << company;
  }
}

TEST(LazyBounds, HoldWhenTheLatticeIsFlattenedOrCollapsed) {
  TriangleSource random(504);
  for (const NamedShape& named : shapes()) {
    AllKernels kernels(named.shape);
    for (double squeeze : {0.0, 0x1p-1060, 1e-20, -1.0})
      for (const Vec3& axes :
           {Vec3(1, 1, squeeze), Vec3(squeeze, 1, squeeze), Vec3(squeeze, squeeze, squeeze)}) {
        std::vector<Vec3> nodes = deformed_nodes(*named.shape, {0.3}, random);
        for (Vec3& n : nodes) n = n.cwiseProduct(axes) + Vec3(0, 3e5, 0);
        EXPECT_EQ(kernels.broken(nodes), "") << named.name << " " << axes.transpose();
      }
  }
}

TEST(LazyBounds, HoldWhenOneNodeIsFarAway) {
  TriangleSource random(505);
  for (const NamedShape& named : shapes()) {
    AllKernels kernels(named.shape);
    for (double distance : {10.0, 1e6, -1e15, 1e200})
      for (int round = 0; round < 4; ++round) {
        std::vector<Vec3> nodes = deformed_nodes(*named.shape, {0.2}, random);
        const int node = random.below(static_cast<int>(nodes.size()));
        nodes[static_cast<std::size_t>(node)] += random.point(Vec3::Zero(), distance);
        EXPECT_EQ(kernels.broken(nodes), "") << named.name << " " << distance << " " << node;
      }
  }
}

bool neighbours(const GridIndex& a, const GridIndex& b) {
  for (int k = 0; k < 3; ++k)
    if (a[k] > b[k] + 1 || b[k] > a[k] + 1) return false;
  return true;
}

TEST(LazyBounds, AreTestedWithTrianglesBetweenCellsThatAreNoNeighbours) {
  const BodyShape& shape = *shapes()[6].shape;
  int far = 0;
  for (const Triangle& t : shape.mesh.triangles) {
    const auto cell = [&](int k) { return shape.lattice->cells[shape.embedding.home_cell[t[k]]]; };
    far += !neighbours(cell(0), cell(1)) && !neighbours(cell(1), cell(2));
  }
  EXPECT_GT(far, 20);
}

TEST(LazyBounds, ShrunkOrMovedByOnePercentAreReported) {
  for (const ShapePtr& shape :
       {test::box_on_its_nodes(10), make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 4), {2, 2, 2})})
    for (const std::string& isa : lazy_isas()) {
      OneBody body(shape, false);
      body.begin(rest_nodes_at(*shape, Vec3(3, 4, 5)));
      ASSERT_EQ(body.broken(lazy_kernels(isa)), "");
      const int lanes = lanes_of(body.tree());
      EXPECT_GE(lanes, 8);
      EXPECT_EQ(reported_lanes(body, shrink), lanes) << isa;
      EXPECT_EQ(reported_lanes(body, move_up), lanes) << isa;
      EXPECT_EQ(reported_lanes(body, move_down), lanes) << isa;
    }
}

TEST(LazyBounds, SlabsShrunkOrMovedAreReported) {
  OneBody body(make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 4), {2, 2, 2}), false);
  for (const std::string& isa : lazy_isas()) {
    body.begin(rest_nodes_at(body.shape(), Vec3(3, 4, 5)));
    ASSERT_EQ(body.broken(lazy_kernels(isa)), "");
    int lanes = 0, narrow = 0, moved = 0;
    for (std::uint32_t b = 0; b < body.tree().blocks.size(); ++b)
      for (std::uint32_t c = 0; c < body.tree().blocks[b].children; ++c, ++lanes) {
        LaneSlabs& slabs = body.state().blocks.find(b)->slab;
        ASSERT_LT(slabs.half[c], kNoSlab);
        const LaneSlabs before = slabs;
        slabs.half[c] *= 0.9f;
        narrow += !body.broken().empty();
        slabs = before;
        slabs.middle[c] += 0.1f * slabs.half[c];
        moved += !body.broken().empty();
        slabs = before;
      }
    // At rest nothing bends: slabs are tight but for the slack, which is most of the thinnest.
    EXPECT_GT(narrow, 9 * lanes / 10) << isa;
    EXPECT_GT(moved, 9 * lanes / 10) << isa;
  }
}

// Share of the lanes with slabs in which the slab is thinner than half the box's shortest side.
TEST(LazyBounds, SlabsAreThinAcrossTheSurfaceUnderDeformation) {
  OneBody body(make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 5), {4, 4, 4}), false);
  TriangleSource random(508);
  body.begin(deformed_nodes(body.shape(), {0.05}, random));
  ASSERT_EQ(body.broken(lazy_kernels()), "");
  int lanes = 0, thin = 0;
  for (std::uint32_t b = 0; b < body.tree().blocks.size(); ++b)
    for (std::uint32_t c = 0; c < body.tree().blocks[b].children; ++c, ++lanes) {
      const BlockBounds& bounds = *body.state().blocks.find(b);
      float longest = 0.0f;
      for (int k = 0; k < 3; ++k)
        longest = std::max(longest, bounds.box.hi[k][c] - bounds.box.lo[k][c]);
      thin += 2.0f * bounds.slab.half[c] < 0.4f * longest;
    }
  EXPECT_GT(lanes, 500);
  EXPECT_GT(thin, 9 * lanes / 10);
}

TEST(LazyBounds, OfRefittedBodiesShrunkOrMovedByOnePercentAreReportedUnderDeformation) {
  TriangleSource random(506);
  for (const NamedShape& named : shapes()) {
    OneBody body(named.shape, true);
    body.begin(deformed_nodes(body.shape(), {0.3}, random));
    ASSERT_EQ(body.broken(lazy_kernels()), "");
    const int lanes = lanes_of(body.tree());
    EXPECT_EQ(reported_lanes(body, shrink), lanes) << named.name;
    EXPECT_EQ(reported_lanes(body, move_up), lanes) << named.name;
    EXPECT_EQ(reported_lanes(body, move_down), lanes) << named.name;
  }
}

// How far a lane sticks out beyond its vertices, at most.
double excess(OneBody& body, std::uint32_t block, std::uint32_t lane, int axis) {
  const auto triangles = triangles_under(body.tree(), body.tree().blocks[block].child[lane]);
  const Aabb truth = body.box_of(triangles);
  const LaneBoxes& boxes = body.state().blocks.find(block)->box;
  return std::max(truth.lo[axis] - boxes.lo[axis][lane], boxes.hi[axis][lane] - truth.hi[axis]);
}

TEST(LazyBounds, OfPiecesAreTightAtRest) {
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(40, -3e3, 1e6)})
    for (const std::string& isa : lazy_isas()) {
      OneBody body(make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 4), {2, 2, 2}), false);
      body.begin(rest_nodes_at(body.shape(), offset));
      ASSERT_EQ(body.broken(lazy_kernels(isa)), "");
      const Vec3 cell = body.state().scale * body.shape().lattice->cell_box(0).extent();
      for (std::uint32_t b = 0; b < body.tree().blocks.size(); ++b)
        for (std::uint32_t c = 0; c < body.tree().blocks[b].children; ++c)
          for (int k = 0; k < 3; ++k)
            ASSERT_LE(excess(body, b, c, k),
                      0.5005 * cell[k] / PieceLanes::kSteps + 2.0 * body.state().slack)
                << isa << " block " << b << " lane " << c;
    }
}

TEST(LazyBounds, LeaveLanesWithoutAChildEmpty) {
  int empty = 0;
  for (const NamedShape& named : shapes())
    for (const std::string& isa : lazy_isas()) {
      OneBody body(named.shape, false);
      body.begin(rest_nodes_at(*named.shape, Vec3(1e300, 0, 0)));  // slack without a limit
      ASSERT_EQ(body.broken(lazy_kernels(isa)), "");
      for (std::uint32_t b = 0; b < body.tree().blocks.size(); ++b)
        for (std::uint32_t c = body.tree().blocks[b].children; c < kBlockWidth; ++c, ++empty)
          for (int k = 0; k < 3; ++k) {
            const LaneBoxes& boxes = body.state().blocks.find(b)->box;
            EXPECT_GT(boxes.lo[k][c], boxes.hi[k][c]) << named.name << " " << isa;
          }
    }
  EXPECT_GT(empty, 0);
}

TEST(LazyBounds, AreMadeOncePerFrame) {
  OneBody body(shapes()[1].shape, false);
  body.begin(rest_nodes_at(body.shape(), Vec3::Zero()));
  EXPECT_EQ(body.made().blocks_bounded, 0u);
  lazy_kernels().bound_all(body.state(), body.arena());
  const BlockBounds* const first = body.state().blocks.find(0);
  lazy_kernels().bound_all(body.state(), body.arena());
  EXPECT_EQ(body.state().blocks.find(0), first);
  EXPECT_EQ(body.made().blocks_bounded, body.tree().blocks.size());
  body.begin(rest_nodes_at(body.shape(), Vec3(5, 0, 0)));
  EXPECT_EQ(body.made().blocks_bounded, 0u);
  lazy_kernels().bound_all(body.state(), body.arena());
  EXPECT_EQ(body.made().blocks_bounded, body.tree().blocks.size());
  EXPECT_EQ(body.broken(), "");
}

}  // namespace
}  // namespace contactcheck
