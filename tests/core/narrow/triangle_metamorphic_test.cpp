// Relations that must hold whatever the answer is: order, corner order, mirrored and turned axes,
// exact scaling, and agreement of the two tests where both can express the question.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/narrow/triangle_box.h"
#include "core/narrow/triangle_triangle.h"
#include "tests/support/random_triangles.h"

namespace contactcheck {
namespace {

struct Pair {
  TrianglePoints p, q;
};

TrianglePoints turned_axes(const TrianglePoints& t) {
  TrianglePoints result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = Vec3(t[i].y(), t[i].z(), t[i].x());
  return result;
}

TrianglePoints mirrored_x(TrianglePoints t) {
  for (Vec3& corner : t) corner.x() = -corner.x();
  return t;
}

TrianglePoints scaled_exactly(TrianglePoints t, double power_of_two) {
  for (Vec3& corner : t) corner *= power_of_two;
  return t;
}

TrianglePoints moved_exactly(TrianglePoints t, const Vec3& offset) {
  for (Vec3& corner : t) corner += offset;
  return t;
}

void expect_order_does_not_matter(const Pair& pair, bool expected) {
  std::array<std::size_t, 3> order = {0, 1, 2};
  do {
    const TrianglePoints p = {pair.p[order[0]], pair.p[order[1]], pair.p[order[2]]};
    EXPECT_EQ(triangles_intersect(p, pair.q), expected);
    EXPECT_EQ(triangles_intersect(pair.q, p), expected);
  } while (std::next_permutation(order.begin(), order.end()));
}

void expect_invariant(const Pair& pair) {
  const auto& [p, q] = pair;
  const bool expected = triangles_intersect(p, q);
  expect_order_does_not_matter(pair, expected);
  EXPECT_EQ(triangles_intersect(turned_axes(p), turned_axes(q)), expected);
  EXPECT_EQ(triangles_intersect(mirrored_x(p), mirrored_x(q)), expected);
  EXPECT_EQ(triangles_intersect(scaled_exactly(p, 0x1p-340), scaled_exactly(q, 0x1p-340)),
            expected);
  EXPECT_EQ(triangles_intersect(scaled_exactly(p, 0x1p340), scaled_exactly(q, 0x1p340)), expected);
}

TEST(TrianglesIntersectRelations, GenericTriangles) {
  test::TriangleSource source(31);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Pair pair = {source.triangle(Vec3::Zero(), 1.0), source.triangle(Vec3::Zero(), 1.0)};
    expect_invariant(pair);
    hits += triangles_intersect(pair.p, pair.q);
  }
  EXPECT_GT(hits, 300);
  EXPECT_LT(hits, 900);
}

TEST(TrianglesIntersectRelations, SmallIntegerGrid) {
  test::TriangleSource source(32);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Pair pair = {source.grid_triangle(1), source.grid_triangle(1)};
    expect_invariant(pair);
    hits += triangles_intersect(pair.p, pair.q);
    const Vec3 offset(1e6, -1e6, 3e6);  // exact for integers
    EXPECT_EQ(triangles_intersect(moved_exactly(pair.p, offset), moved_exactly(pair.q, offset)),
              triangles_intersect(pair.p, pair.q));
  }
  EXPECT_GT(hits, 1000);
  EXPECT_LT(hits, 2200);
}

TEST(TrianglesIntersectRelations, OffByUlps) {
  test::TriangleSource source(33);
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const TrianglePoints p = source.triangle(Vec3(1, 2, 3), 1.0);
    const Pair pair = {p, source.near_degenerate_partner(p, 1.0)};
    expect_invariant(pair);
    hits += triangles_intersect(pair.p, pair.q);
  }
  EXPECT_GT(hits, 200);
  EXPECT_LT(hits, 800);
}

TEST(TrianglesIntersectRelations, AnyPointOfATriangleMeetsIt) {
  test::TriangleSource source(34);
  for (int i = 0; i < 500; ++i) {
    TrianglePoints p = source.grid_triangle(4);
    p = scaled_exactly(p, 4.0);  // the middle of every edge and its middle are integers
    const Vec3 edge_middle = 0.5 * (p[0] + p[1]), inner = 0.5 * (edge_middle + p[2]);
    EXPECT_TRUE(triangles_intersect(p, {edge_middle, edge_middle, edge_middle}));
    EXPECT_TRUE(triangles_intersect(p, {inner, inner + Vec3(0, 3, 1), inner + Vec3(1, 0, 5)}));
  }
}

/// The surface of a box as twelve triangles.
std::vector<TrianglePoints> box_surface(const Aabb& box) {
  std::vector<TrianglePoints> result;
  for (int axis = 0; axis < 3; ++axis) {
    const int first = (axis + 1) % 3, second = (axis + 2) % 3;
    for (double level : {box.lo[axis], box.hi[axis]}) {
      std::array<Vec3, 4> corners;
      for (int i = 0; i < 4; ++i) {
        Vec3& corner = corners[static_cast<std::size_t>(i)];
        corner[axis] = level;
        corner[first] = i == 1 || i == 2 ? box.hi[first] : box.lo[first];
        corner[second] = i >= 2 ? box.hi[second] : box.lo[second];
      }
      result.push_back({corners[0], corners[1], corners[2]});
      result.push_back({corners[0], corners[2], corners[3]});
    }
  }
  return result;
}

bool meets_surface_or_inside(const TrianglePoints& t, const Aabb& box) {
  if (box.contains(t[0])) return true;
  for (const TrianglePoints& face : box_surface(box))
    if (triangles_intersect(t, face)) return true;
  return false;
}

TEST(TriangleMeetsBoxRelations, EqualsSurfaceOrInside) {
  test::TriangleSource source(35);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const bool grid = i % 2 == 0;
    const TrianglePoints t = grid ? source.grid_triangle(2) : source.triangle(Vec3::Zero(), 1.5);
    const Aabb box = grid ? source.grid_box(2) : source.box(Vec3::Zero(), 1.0);
    const bool expected = meets_surface_or_inside(t, box);
    EXPECT_EQ(triangle_meets_box(t, box), expected) << i;
    EXPECT_EQ(triangle_meets_box({t[2], t[1], t[0]}, box), expected) << i;
    EXPECT_EQ(triangle_meets_box({t[1], t[2], t[0]}, box), expected) << i;
    hits += expected;
  }
  EXPECT_GT(hits, 700);
  EXPECT_LT(hits, 2300);
}

}  // namespace
}  // namespace contactcheck
