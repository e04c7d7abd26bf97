// The judge judged: hand-made cases with known answers, and its two ways to say "disjoint".

#include "reference/oracle/rational_geometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

using oracle::rational::TriangleCorners;

const TriangleCorners kTriangle = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

mpq_class distance_to(const TriangleCorners& t) {
  return oracle::rational::squared_distance(kTriangle, t);
}

TriangleCorners point(const Vec3& p) { return {p, p, p}; }

TEST(RationalSimplex, FeasibleInfeasibleAndRedundant) {
  EXPECT_TRUE(oracle::rational::has_nonnegative_solution({{{1, 1}, 1}}));
  EXPECT_FALSE(oracle::rational::has_nonnegative_solution({{{1, 1}, -1}}));
  EXPECT_TRUE(oracle::rational::has_nonnegative_solution({{{-1, 1}, -1}}));
  EXPECT_TRUE(oracle::rational::has_nonnegative_solution({{{1, 1}, 1}, {{2, 2}, 2}, {{1, -1}, 0}}));
  EXPECT_FALSE(oracle::rational::has_nonnegative_solution({{{1, 1}, 1}, {{2, 2}, 3}}));
  EXPECT_FALSE(oracle::rational::has_nonnegative_solution({{{1, 1}, 1}, {{1, -1}, 2}}));
}

TEST(RationalOrient, SignsOfTheUnitCorner) {
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_EQ(oracle::rational::orient3d(o, x, y, z), 1);
  EXPECT_EQ(oracle::rational::orient3d(o, y, x, z), -1);
  EXPECT_EQ(oracle::rational::orient3d(o, x, y, x), 0);
  EXPECT_EQ(oracle::rational::orient2d(o, x, y, 2), 1);
  EXPECT_EQ(oracle::rational::orient2d(o, z, y, 0), -1);
}

TEST(RationalTrianglesIntersect, KnownAnswers) {
  EXPECT_TRUE(oracle::rational::triangles_intersect(kTriangle, kTriangle));
  EXPECT_TRUE(oracle::rational::triangles_intersect(
      kTriangle, {Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(9, 9, 1)}));
  EXPECT_TRUE(oracle::rational::triangles_intersect(kTriangle, point(Vec3(2, 2, 0))));
  EXPECT_FALSE(oracle::rational::triangles_intersect(kTriangle, point(Vec3(2, 2, 5e-324))));
  EXPECT_FALSE(oracle::rational::triangles_intersect(
      kTriangle, {Vec3(3, 3, 0), Vec3(5, 3, 0), Vec3(3, 5, 0)}));
}

TEST(RationalTriangleMeetsBox, KnownAnswers) {
  Aabb box;
  EXPECT_FALSE(oracle::rational::triangle_meets_box(kTriangle, box));
  box.extend(Vec3(2, 2, -1));
  box.extend(Vec3(3, 3, 1));
  EXPECT_TRUE(oracle::rational::triangle_meets_box(kTriangle, box));
  box.lo.x() = std::nextafter(2.0, 3.0);
  EXPECT_FALSE(oracle::rational::triangle_meets_box(kTriangle, box));
}

TEST(RationalSquaredDistance, ToFaceEdgeCornerAndSkewEdge) {
  EXPECT_EQ(distance_to(point(Vec3(1, 1, 3))), 9);
  EXPECT_EQ(distance_to(point(Vec3(1, -2, 0))), 4);
  EXPECT_EQ(distance_to(point(Vec3(3, 3, 0))), 2);
  EXPECT_EQ(distance_to(point(Vec3(7, -4, 12))), 9 + 16 + 144);
  EXPECT_EQ(distance_to({Vec3(2, -3, -9), Vec3(2, -3, 9), Vec3(2, -3, 9)}), 9);
  EXPECT_EQ(distance_to(kTriangle), 0);
}

TEST(RationalSquaredDistance, ExactBelowTheRangeOfDoubles) {
  const mpq_class d = distance_to(point(Vec3(1, 1, 5e-324)));
  EXPECT_GT(d, 0);
  EXPECT_EQ(d, mpq_class(5e-324) * mpq_class(5e-324));
}

TEST(RationalSquaredDistance, IsSymmetricAndZeroExactlyAtIntersections) {
  TriangleSource source(51);
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const TriangleCorners p = source.grid_triangle(2), q = source.grid_triangle(2);
    const mpq_class d = oracle::rational::squared_distance(p, q);
    EXPECT_EQ(d, oracle::rational::squared_distance(q, p));
    EXPECT_EQ(d == 0, oracle::rational::triangles_intersect(p, q));
    hits += d == 0;
  }
  EXPECT_GT(hits, 150);
  EXPECT_LT(hits, 700);
}

/// The points with barycentric coordinates in multiples of 1/steps: never closer than the distance.
TEST(RationalSquaredDistance, NoSampledPointPairIsCloser) {
  TriangleSource source(52);
  static constexpr int kSteps = 4;  // a power of two: the samples of a small grid are exact
  const auto sample = [](const TriangleCorners& t, int i, int j) -> Vec3 {
    return (i * t[0] + j * t[1] + (kSteps - i - j) * t[2]) / kSteps;
  };
  for (int n = 0; n < 60; ++n) {
    const TriangleCorners p = source.grid_triangle(3), q = source.grid_triangle(3);
    const mpq_class d = oracle::rational::squared_distance(p, q);
    mpq_class closest = 1000;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j)
        for (int k = 0; k <= kSteps; ++k)
          for (int l = 0; k + l <= kSteps; ++l) {
            const mpq_class s = (sample(p, i, j) - sample(q, k, l)).squaredNorm();
            if (s < closest) closest = s;
          }
    EXPECT_LE(d, closest);
    // Every point of a triangle is within a quarter of its longest edge of a sample.
    EXPECT_LE(closest.get_d(), std::pow(std::sqrt(d.get_d()) + 2 * 6 * std::sqrt(3.0) / kSteps, 2));
  }
}

}  // namespace
}  // namespace contactcheck::test
