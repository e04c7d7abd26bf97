// A mapped leaf: the bits of the canonical mapping, and boxes that hold its triangles.

#include <gtest/gtest.h>

#include "core/lazy/kernels.h"
#include "tests/core/lazy/mapped_leaves.h"

namespace contactcheck {
namespace {

using test::Deformation;
using test::for_each_mapped_leaf;
using test::OneBody;
using test::rest_nodes_at;

const Deformation kDeformations[] = {{0.0},
                                     {0.4},
                                     {50.0},
                                     {0.4, 1e-300},
                                     {0.4, 1e200, {1e12, 0, 0}},
                                     {0.4, 1.0, {1e12, -1e12, 3e11}},
                                     {0.4, 1e-9, {1e300, 1.0, -1e300}}};

TEST(MapLeaf, GivesTheBitsOfTheMappingOnEveryInstructionSet) {
  const test::BitTally tally = test::compare_bits<double>(11, kDeformations);
  EXPECT_EQ(tally.different, 0u);
  EXPECT_GT(tally.vertices, 10000 * lazy_isas().size());
}

struct FrameBox {
  float lo[3], hi[3];
};

bool holds(const FrameBox& box, const Aabb& content) {
  for (int k = 0; k < 3; ++k)
    if (!(box.lo[k] <= content.lo[k] && content.hi[k] <= box.hi[k])) return false;
  return true;
}

FrameBox lane_of(const LaneBoxes& boxes, std::uint32_t lane) {
  FrameBox out;
  for (int k = 0; k < 3; ++k) {
    out.lo[k] = boxes.lo[k][lane];
    out.hi[k] = boxes.hi[k][lane];
  }
  return out;
}

TEST(MapLeaf, GivesBoxesThatHoldTheirTriangles) {
  for_each_mapped_leaf<double>(
      11, kDeformations, [&](OneBody& body, std::uint32_t l, const LeafCache& cache) {
        const TreeLeaf& leaf = body.tree().leaves[l];
        for (std::uint32_t i = 0; i < leaf.triangles; ++i) {
          const Aabb truth = body.box_of(
              std::span(body.tree().leaf_triangles).subspan(leaf.first_triangle + i, 1));
          ASSERT_TRUE(holds(lane_of(cache.boxes[i / kBlockWidth], i % kBlockWidth), truth));
          ASSERT_TRUE(holds(lane_of(*cache.whole, 0), truth));
        }
      });
}

TEST(MapLeaf, LeavesLanesWithoutATriangleEmpty) {
  int empty = 0;
  for_each_mapped_leaf<double>(
      11, kDeformations, [&](OneBody& body, std::uint32_t l, const LeafCache& cache) {
        for (std::uint32_t i = body.tree().leaves[l].triangles; i < kLeafTriangles; ++i, ++empty) {
          const FrameBox box = lane_of(cache.boxes[i / kBlockWidth], i % kBlockWidth);
          for (int k = 0; k < 3; ++k) ASSERT_GT(box.lo[k], box.hi[k]);
        }
      });
  EXPECT_GT(empty, 0);
}

TEST(MapLeaf, GivesTightBoxes) {
  OneBody body(make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 3), {4, 4, 4}), false);
  test::TriangleSource random(12);
  body.begin(deformed_nodes(body.shape(), {0.3}, random));
  for (std::uint32_t l = 0; l < body.tree().leaves.size(); ++l) {
    const LeafCache& cache = lazy_kernels().map_leaf(body.state(), l, body.arena());
    const TreeLeaf& leaf = body.tree().leaves[l];
    const Aabb truth = body.box_of(
        std::span(body.tree().leaf_triangles).subspan(leaf.first_triangle, leaf.triangles));
    for (int k = 0; k < 3; ++k) {
      EXPECT_LT(truth.lo[k] - cache.whole->lo[k][0], 2.0 * body.state().slack);
      EXPECT_LT(cache.whole->hi[k][0] - truth.hi[k], 2.0 * body.state().slack);
    }
  }
}

TEST(MapLeaf, MapsOncePerFrameAndAnewInTheNext) {
  for (const std::string& isa : lazy_isas()) {
    OneBody body(make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 3), {4, 4, 4}), false);
    const LazyKernels& kernels = lazy_kernels(isa);
    body.begin(rest_nodes_at(body.shape(), Vec3::Zero()));
    const double* const first = kernels.map_leaf(body.state(), 2, body.arena()).x;
    EXPECT_EQ(kernels.map_leaf(body.state(), 2, body.arena()).x, first);
    EXPECT_EQ(body.made().leaves_mapped, 1u);
    EXPECT_EQ(body.made().vertices_mapped, body.tree().leaves[2].vertices);
    const double before = *first;
    body.begin(rest_nodes_at(body.shape(), Vec3(1, 0, 0)));
    EXPECT_EQ(body.made().leaves_mapped, 0u);
    EXPECT_NEAR(*kernels.map_leaf(body.state(), 2, body.arena()).x, before + 1.0, 1e-12);
    EXPECT_EQ(body.made().leaves_mapped, 1u);
  }
}

// As after 2^32 frames, with a stamp of eight bits: 255 frames, and the table is made anew.
TEST(FrameTable, KnowsNothingOfAnEarlierFrameWhateverTheStampsSay) {
  FrameTable<int, std::uint8_t> table;
  int made = 0;
  for (int frame = 1; frame <= 600; ++frame) {
    table.begin_frame(2);
    EXPECT_EQ(table.find(0), nullptr) << frame;
    EXPECT_EQ(table.find(1), nullptr) << frame;
    // One of the two is left out in most frames: its stamp grows old.
    if (frame % 256 <= 1) table.put(0, &made);
    table.put(1, &made);
    EXPECT_EQ(table.find(1), &made) << frame;
  }
}

}  // namespace
}  // namespace contactcheck
