#include "core/narrow/triangle_box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/range_ends.h"

namespace contactcheck {
namespace {

Aabb box(const Vec3& lo, const Vec3& hi) {
  Aabb result;
  result.extend(lo);
  result.extend(hi);
  return result;
}

const Aabb kUnit = box(Vec3(0, 0, 0), Vec3(1, 1, 1));

double above(double value) {
  return std::nextafter(value, std::numeric_limits<double>::infinity());
}

TEST(TriangleMeetsBox, InsideAroundAndThrough) {
  EXPECT_TRUE(triangle_meets_box({Vec3(.2, .2, .2), Vec3(.4, .2, .3), Vec3(.2, .5, .2)}, kUnit));
  EXPECT_TRUE(triangle_meets_box({Vec3(-9, -9, .5), Vec3(9, -9, .5), Vec3(0, 30, .5)}, kUnit));
  EXPECT_TRUE(triangle_meets_box({Vec3(-1, .5, .5), Vec3(2, .5, .5), Vec3(2, .6, 9)}, kUnit));
  EXPECT_FALSE(triangle_meets_box({Vec3(2, 0, 0), Vec3(3, 0, 0), Vec3(2, 1, 1)}, kUnit));
}

TEST(TriangleMeetsBox, EmptyBoxMeetsNothing) {
  EXPECT_FALSE(triangle_meets_box({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, Aabb()));
}

TEST(TriangleMeetsBox, TouchesFaceByVertexEdgeAndPlane) {
  EXPECT_TRUE(triangle_meets_box({Vec3(1, .5, .5), Vec3(2, 0, 0), Vec3(2, 1, 0)}, kUnit));
  EXPECT_FALSE(triangle_meets_box({Vec3(above(1), .5, .5), Vec3(2, 0, 0), Vec3(2, 1, 0)}, kUnit));
  EXPECT_TRUE(triangle_meets_box({Vec3(-1, -1, 1), Vec3(5, -1, 1), Vec3(-1, 5, 1)}, kUnit));
  const double over = above(1);
  EXPECT_FALSE(
      triangle_meets_box({Vec3(-1, -1, over), Vec3(5, -1, over), Vec3(-1, 5, over)}, kUnit));
}

TEST(TriangleMeetsBox, TiltedPlaneAtTheCorner) {
  // x + y + z = 3 touches the corner (1, 1, 1) inside the triangle.
  EXPECT_TRUE(triangle_meets_box({Vec3(3, 0, 0), Vec3(0, 3, 0), Vec3(0, 0, 3)}, kUnit));
  EXPECT_FALSE(triangle_meets_box(
      {Vec3(above(3), 0, 0), Vec3(0, above(3), 0), Vec3(0, 0, above(3))}, kUnit));
  const Aabb mirrored = box(Vec3(-1, -1, -1), Vec3(0, 0, 0));
  EXPECT_TRUE(triangle_meets_box({Vec3(-3, 0, 0), Vec3(0, -3, 0), Vec3(0, 0, -3)}, mirrored));
  EXPECT_FALSE(triangle_meets_box({Vec3(-3.5, 0, 0), Vec3(0, -3, 0), Vec3(0, 0, -3)}, mirrored));
}

TEST(TriangleMeetsBox, EdgeTouchesEdgeOfTheBox) {
  // The edge from (2, 0, 1) to (0, 2, 1)... seen along z passes x + y = 2 through (1, 1).
  EXPECT_TRUE(triangle_meets_box({Vec3(2, 0, 0), Vec3(0, 2, 1), Vec3(3, 3, 0)}, kUnit));
  EXPECT_FALSE(
      triangle_meets_box({Vec3(above(2), 0, 0), Vec3(0, above(2), 1), Vec3(3, 3, 0)}, kUnit));
  EXPECT_TRUE(triangle_meets_box({Vec3(0, 2, 0), Vec3(1, 0, 2), Vec3(0, 3, 3)}, kUnit));
  EXPECT_FALSE(
      triangle_meets_box({Vec3(0, above(2), 0), Vec3(1, 0, above(2)), Vec3(0, 3, 3)}, kUnit));
  EXPECT_TRUE(triangle_meets_box({Vec3(2, 0, 0), Vec3(0, 1, 2), Vec3(3, 0, 3)}, kUnit));
  EXPECT_FALSE(
      triangle_meets_box({Vec3(above(2), 0, 0), Vec3(0, 1, above(2)), Vec3(3, 0, 3)}, kUnit));
}

TEST(TriangleMeetsBox, OverlapOfBoundsIsNotEnough) {
  EXPECT_FALSE(
      triangle_meets_box({Vec3(1.9, .5, .5), Vec3(.5, 1.9, .5), Vec3(1.9, 1.9, .5)}, kUnit));
}

TEST(TriangleMeetsBox, SegmentAndPointTriangles) {
  EXPECT_TRUE(triangle_meets_box({Vec3(-1, -1, -1), Vec3(2, 2, 2), Vec3(.3, .3, .3)}, kUnit));
  EXPECT_TRUE(triangle_meets_box({Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(1, 1, 0)}, kUnit));
  EXPECT_FALSE(triangle_meets_box({Vec3(3, 0, 0), Vec3(0, 3, 0), Vec3(3, 0, 0)}, kUnit));
  EXPECT_FALSE(triangle_meets_box({Vec3(0, 3, 0), Vec3(0, 3, 0), Vec3(3, 0, 0)}, kUnit));
  const Vec3 corner(1, 1, 1), out(1, 1, above(1));
  EXPECT_TRUE(triangle_meets_box({corner, corner, corner}, kUnit));
  EXPECT_FALSE(triangle_meets_box({out, out, out}, kUnit));
}

TEST(TriangleMeetsBox, FlatBoxes) {
  const Aabb plate = box(Vec3(0, 0, 0), Vec3(1, 1, 0)), bar = box(Vec3(0, 0, 0), Vec3(1, 0, 0));
  const Aabb point = box(Vec3(1, 1, 0), Vec3(1, 1, 0));
  const TrianglePoints in_plane = {Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(3, 3, 0)};
  EXPECT_TRUE(triangle_meets_box(in_plane, plate));
  EXPECT_FALSE(triangle_meets_box(in_plane, bar));
  EXPECT_TRUE(triangle_meets_box(in_plane, point));
  EXPECT_TRUE(triangle_meets_box({Vec3(.5, 0, -1), Vec3(.5, 0, 1), Vec3(.5, 9, 0)}, bar));
  EXPECT_FALSE(triangle_meets_box(
      {Vec3(.5, test::kSmallestDouble, -1), Vec3(.5, test::kSmallestDouble, 1), Vec3(.5, 9, 0)},
      bar));
  EXPECT_FALSE(triangle_meets_box({Vec3(2, 0, 0), Vec3(0, above(2), 0), Vec3(3, 3, 0)}, point));
}

TEST(TriangleMeetsBox, SameAnswersAtEveryScale) {
  for (double scale :
       {test::kSmallestDouble, 0x1p-1022, 0x1p-532, 0x1p-30, 0x1p30, 0x1p332, 0x1p532, 0x1p1021}) {
    const Aabb scaled_box = box(Vec3::Zero(), Vec3::Constant(scale));
    const Vec3 x(3 * scale, 0, 0), y(0, 3 * scale, 0), z(0, 0, 3 * scale);
    EXPECT_TRUE(triangle_meets_box({x, y, z}, scaled_box)) << scale;
    EXPECT_FALSE(triangle_meets_box({x, y, Vec3(0, scale, 3 * scale)}, scaled_box)) << scale;
  }
}

}  // namespace
}  // namespace contactcheck
