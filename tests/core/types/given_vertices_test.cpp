#include "core/types/given_vertices.h"

#include <gmock/gmock.h>

#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Two triangles; 0, 3, 4 and 7 are used by none.
TriangleMesh with_strays() {
  TriangleMesh mesh;
  for (int v = 0; v < 8; ++v) mesh.vertices.push_back({1.0 * v, 10.0 * v * v, 1.0});
  mesh.triangles = {{1, 2, 5}, {5, 2, 6}};
  return mesh;
}

TEST(DropUnusedVertices, KeepsTheOrderAndTheNumbersOfTheOthers) {
  TriangleMesh mesh = with_strays();
  const TriangleMesh before = mesh;
  const GivenVertices given = drop_unused_vertices(mesh);
  EXPECT_EQ(given.dropped, 4u);
  EXPECT_THAT(given.numbers, ElementsAre(1u, 2u, 5u, 6u));
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}));
  for (std::uint32_t v = 0; v < 4; ++v)
    EXPECT_EQ(mesh.vertices[v], before.vertices[given.number_of(v)]);
  EXPECT_EQ(given.numbered(mesh.triangles), before.triangles);
}

TEST(DropUnusedVertices, OfAMeshThatUsesAllChangesNothing) {
  TriangleMesh mesh = test::unit_box_mesh(2);
  const TriangleMesh before = mesh;
  const GivenVertices given = drop_unused_vertices(mesh);
  EXPECT_EQ(given.dropped, 0u);
  EXPECT_THAT(given.numbers, IsEmpty());
  EXPECT_EQ(mesh.vertices, before.vertices);
  EXPECT_EQ(mesh.triangles, before.triangles);
  EXPECT_EQ(given.number_of(7), 7u);
  EXPECT_EQ(given.vertex_of(7), 7u);
  EXPECT_EQ(given.kept(before.vertices), before.vertices);
  EXPECT_EQ(given.spread(before.vertices), before.vertices);
}

TEST(GivenVertices, NumberAndVertexLeadToOneAnother) {
  TriangleMesh mesh = with_strays();
  const GivenVertices given = drop_unused_vertices(mesh);
  for (std::uint32_t v = 0; v < 4; ++v) EXPECT_EQ(given.vertex_of(given.number_of(v)), v);
  for (const std::uint32_t number : {0u, 3u, 4u, 7u})
    EXPECT_EQ(given.vertex_of(number), std::nullopt) << number;
}

TEST(GivenVertices, WhatWasDroppedHasTheValueOfTheOneBeforeIt) {
  TriangleMesh mesh = with_strays();
  const GivenVertices given = drop_unused_vertices(mesh);
  EXPECT_THAT(given.spread(std::vector{1, 2, 5, 6}), ElementsAre(1, 1, 2, 2, 2, 5, 6, 6));
  EXPECT_THAT(given.kept(std::vector{0, 1, 2, 3, 4, 5, 6, 7}), ElementsAre(1, 2, 5, 6));
}

TEST(BoundingBox, OfAMeshIsThatOfItsTriangles) {
  const Aabb box = bounding_box(with_strays());
  EXPECT_EQ(box.lo, Vec3(1, 10, 1));
  EXPECT_EQ(box.hi, Vec3(6, 360, 1));
}

}  // namespace
}  // namespace contactcheck
