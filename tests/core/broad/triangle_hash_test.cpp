#include "core/broad/triangle_hash.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

using test::FrameData;

struct Boxes {
  std::vector<Body> bodies;
  FrameData frame;
};

/// Unit boxes of n x n quads per face, at the given places.
Boxes boxes_at(const std::vector<Vec3>& places, int n = 4) {
  Boxes out;
  const auto shape = make_bare_shape(test::unit_box_mesh(n));
  for (const Vec3& place : places) {
    out.bodies.push_back({"box", shape});
    out.frame.vertices.push_back(shape->mesh.vertices);
    for (Vec3& v : out.frame.vertices.back()) v += place;
  }
  out.frame.nodes = out.frame.vertices;
  return out;
}

TriangleHash updated(const Boxes& boxes, const TriangleHashSettings& settings = {}) {
  TriangleHash hash(settings);
  hash.prepare(boxes.bodies);
  hash.update({boxes.frame.vertices.begin(), boxes.frame.vertices.end()});
  return hash;
}

/// Sorted, but with repeats, should there be any.
std::vector<ElementPair> candidates(TriangleHash& hash) {
  std::vector<ElementPair> out;
  hash.visit_candidates([&](const ElementPair& pair) {
    out.push_back(pair);
    return false;
  });
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<ElementPair> by_brute_force(const Boxes& boxes) {
  const std::vector<Triangle>& triangles = boxes.bodies[0].shape->mesh.triangles;
  const auto box = [&](std::uint32_t body, std::uint32_t t) {
    Aabb out;
    for (std::uint32_t v : triangles[t]) out.extend(boxes.frame.vertices[body][v]);
    return out;
  };
  std::vector<ElementPair> out;
  for (std::uint32_t a = 0; a < boxes.bodies.size(); ++a)
    for (std::uint32_t b = a + 1; b < boxes.bodies.size(); ++b)
      for (std::uint32_t i = 0; i < triangles.size(); ++i)
        for (std::uint32_t j = 0; j < triangles.size(); ++j)
          if (box(a, i).overlaps(box(b, j))) out.push_back({a, b, i, j});
  return out;
}

TEST(TriangleHash, CandidatesAreThePairsOfOverlappingBoxesOnceEach) {
  const Boxes boxes = boxes_at({Vec3(0, 0, 0), Vec3(0.9, 0.3, 0.2), Vec3(-1, 0, 0), Vec3(9, 9, 9)});
  const std::vector<ElementPair> expected = by_brute_force(boxes);
  ASSERT_GT(expected.size(), 100u);
  for (double cell : {0.1, 1.0, 2.0, 50.0}) {
    for (std::uint32_t table : {0u, 1u, 256u}) {
      TriangleHash hash = updated(boxes, {cell, table});
      const std::vector<ElementPair> got = candidates(hash);
      EXPECT_TRUE(std::is_sorted(got.begin(), got.end()));
      EXPECT_EQ(got, expected) << cell << " " << table;
      EXPECT_GE(hash.visited(), got.size());
      EXPECT_EQ(candidates(hash), expected) << "asked again";
    }
  }
}

TEST(TriangleHash, CellIsInMeanEdgesAtRest) {
  // Edges of a triangle's box in a face of n x n quads: 1/n, 1/n, 0.
  for (int n : {1, 4}) {
    const Boxes boxes = boxes_at({Vec3(0, 0, 0), Vec3(0.5, 0, 0)}, n);
    EXPECT_NEAR(updated(boxes, {1.0, 0}).cell_size(), 2.0 / 3.0 / n, 1e-12);
    EXPECT_NEAR(updated(boxes, {3.0, 0}).cell_size(), 2.0 / n, 1e-12);
  }
}

TEST(TriangleHash, CellExistsWithoutEdges) {
  EXPECT_GT(updated({}).cell_size(), 0.0);
  const auto point =
      make_bare_shape(test::triangle_mesh(Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)));
  const Boxes points{{{"a", point}, {"b", point}},
                     {{},
                      {{Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)},
                       {Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)}}}};
  TriangleHash hash = updated({points.bodies, {points.frame.vertices, points.frame.vertices}});
  EXPECT_EQ(candidates(hash), (std::vector<ElementPair>{{0, 1, 0, 0}}));
  EXPECT_GT(hash.cell_size(), 0.0);
}

TEST(TriangleHash, OnlyTrianglesInCommonPartsOfBoundsAreHashed) {
  const std::size_t one = boxes_at({Vec3(0, 0, 0)}).bodies[0].shape->mesh.triangles.size();
  EXPECT_EQ(updated(boxes_at({Vec3(0, 0, 0), Vec3(5, 0, 0)})).hashed(), 0u);
  EXPECT_EQ(updated(boxes_at({Vec3(0, 0, 0), Vec3(0, 0, 0)})).hashed(), 2 * one);
  const std::size_t touching = updated(boxes_at({Vec3(0, 0, 0), Vec3(1, 0, 0)})).hashed();
  EXPECT_GE(touching, 2 * one / 6);  // the common faces at least
  EXPECT_LT(touching, 2 * one / 2);
}

TEST(TriangleHash, VisitsLessWithSmallerBuckets) {
  const Boxes boxes = boxes_at({Vec3(0, 0, 0), Vec3(0.9, 0.3, 0.2)});
  TriangleHash fine = updated(boxes, {2.0, 0}), one_bucket = updated(boxes, {2.0, 1});
  candidates(fine);
  candidates(one_bucket);
  EXPECT_LT(fine.visited(), one_bucket.visited() / 4);
  // Every entry with every other: at least the pairs of what was hashed.
  const std::uint64_t hashed = one_bucket.hashed();
  EXPECT_GE(one_bucket.visited(), hashed * (hashed - 1) / 2);
}

TEST(TriangleHash, TooLargeBoxesAreComparedWithAll) {
  const Boxes boxes = boxes_at({Vec3(0, 0, 0), Vec3(0.9, 0.3, 0.2)});
  TriangleHash hash = updated(boxes, {1e-3, 0});  // all of them are too large
  EXPECT_EQ(candidates(hash), by_brute_force(boxes));
  EXPECT_EQ(hash.visited(), hash.hashed() * hash.hashed());
}

}  // namespace
}  // namespace contactcheck
