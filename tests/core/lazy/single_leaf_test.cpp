// A leaf mapped in single precision: the bits of the mapping in floats, and the boxes of just these
// floats.

#include <gtest/gtest.h>

#include "core/deform/mapping.h"
#include "core/lazy/kernels.h"
#include "tests/core/lazy/mapped_leaves.h"

namespace contactcheck {
namespace {

using test::Deformation;
using test::for_each_mapped_leaf;
using test::OneBody;
using test::ShapePtr;

constexpr Precision kFloats = Precision::kSingle;

const Deformation kLeafDeformations[] = {{0.0},
                                         {0.4},
                                         {50.0},
                                         {0.4, 1e-40},
                                         {0.4, 1e-300},
                                         {0.4, 1e9, {1e12, 0, 0}},
                                         {0.4, 1.0, {1e12, -1e12, 3e11}}};

TEST(MapSingleLeaf, GivesTheBitsOfTheMappingInFloatsOnEveryInstructionSet) {
  const test::BitTally tally = test::compare_bits<float>(31, kLeafDeformations);
  EXPECT_EQ(tally.different, 0u);
  EXPECT_GT(tally.vertices, 10000 * lazy_isas().size());
}

// What full-refit maps at once is what leaves are mapped to one by one.
TEST(MapSingleLeaf, GivesTheBitsOfTheBatchMapping) {
  test::TriangleSource random(32);
  for (const ShapePtr& shape : test::leaf_shapes()) {
    if (!shape->lattice) continue;
    OneBody body(shape, false, kFloats);
    body.begin(deformed_nodes(*shape, {0.4, 1.0, {1e6, 0, 0}}, random));
    std::vector<Vec3f> mapped(shape->mesh.vertices.size());
    map_vertices(*shape->lattice, shape->embedding, single_local(shape->embedding),
                 body.state().single.nodes, mapped);
    EXPECT_EQ(mapped, body.single_vertices());
  }
}

void expect_box(const LaneBoxes& boxes, std::uint32_t lane, const Aabb& truth) {
  for (int k = 0; k < 3; ++k) {
    ASSERT_EQ(static_cast<double>(boxes.lo[k][lane]), truth.lo[k]);
    ASSERT_EQ(static_cast<double>(boxes.hi[k][lane]), truth.hi[k]);
  }
}

TEST(MapSingleLeaf, GivesTheBoxesOfItsTrianglesAndNothingMore) {
  int empty = 0;
  for_each_mapped_leaf<float>(
      31, kLeafDeformations, [&](OneBody& body, std::uint32_t l, const SingleLeafCache& cache) {
        const TreeLeaf& leaf = body.tree().leaves[l];
        const auto triangles = std::span(body.tree().leaf_triangles).subspan(leaf.first_triangle);
        for (std::uint32_t i = 0; i < leaf.triangles; ++i)
          expect_box(cache.boxes[i / kBlockWidth], i % kBlockWidth,
                     body.box_of(triangles.subspan(i, 1)));
        expect_box(*cache.whole, 0, body.box_of(triangles.first(leaf.triangles)));
        for (std::uint32_t i = leaf.triangles; i < kLeafTriangles; ++i, ++empty)
          for (int k = 0; k < 3; ++k)
            ASSERT_GT(cache.boxes[i / kBlockWidth].lo[k][i % kBlockWidth],
                      cache.boxes[i / kBlockWidth].hi[k][i % kBlockWidth]);
      });
  EXPECT_GT(empty, 0);
}

TEST(MapSingleLeaf, MapsOncePerFrameAndAnewInTheNext) {
  test::TriangleSource random(33);
  OneBody body(make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 3), {4, 4, 4}), false, kFloats);
  const LazyKernels& kernels = lazy_kernels();
  body.begin(deformed_nodes(body.shape(), {0.1}, random));
  const float* const first = kernels.map_single_leaf(body.state(), 2, body.arena()).x;
  EXPECT_EQ(kernels.map_single_leaf(body.state(), 2, body.arena()).x, first);
  EXPECT_EQ(body.made().leaves_mapped, 1u);
  EXPECT_EQ(body.made().vertices_mapped, body.tree().leaves[2].vertices);
  body.begin(deformed_nodes(body.shape(), {0.2}, random));
  EXPECT_EQ(body.made().leaves_mapped, 0u);
}

// Digits that floats lose beside the scene's place in the world are kept by the local origin.
TEST(MapSingleLeaf, LosesNothingMoreFarFromTheOriginOfTheWorld) {
  test::TriangleSource random(34);
  OneBody here(test::box_on_its_nodes(6), false, kFloats),
      far(test::box_on_its_nodes(6), false, kFloats);
  std::vector<Vec3> nodes = deformed_nodes(here.shape(), {0.3}, random);
  const double fraction = 0x1p-19;  // a double beside 2^32 holds it, and half of it
  for (Vec3& n : nodes) n = (n / fraction).array().round().matrix() * fraction;
  here.begin(nodes);
  for (Vec3& n : nodes) n += Vec3(0x1p32, -0x1p31, 0x1p30);
  far.begin(nodes);
  EXPECT_EQ(far.single_vertices(), here.single_vertices());
}

}  // namespace
}  // namespace contactcheck
