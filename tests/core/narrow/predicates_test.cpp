#include "core/narrow/predicates.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/support/random_triangles.h"
#include "tests/support/range_ends.h"

namespace contactcheck {
namespace {

const Vec3 kOrigin(0, 0, 0), kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

TEST(Orient3d, PositiveWhereTheTriangleTurnsCounterClockwise) {
  EXPECT_EQ(orient3d(kOrigin, kX, kY, kZ), 1);
  EXPECT_EQ(orient3d(kOrigin, kX, kY, -kZ), -1);
  EXPECT_EQ(orient3d(kOrigin, kY, kX, kZ), -1);
}

TEST(Orient3d, ZeroForCoplanarPoints) {
  EXPECT_EQ(orient3d(kOrigin, kX, kY, Vec3(7, -3, 0)), 0);
  EXPECT_EQ(orient3d(Vec3(1, 2, 3), Vec3(4, 0, 1), Vec3(-2, 5, 2), Vec3(16, -11, 2)), 0);
  EXPECT_EQ(orient3d(kX, kX, kY, kZ), 0);
  EXPECT_EQ(orient3d(kX, kX, kX, kX), 0);
}

TEST(Orient3d, OneUlpOffTheDiagonalPlane) {
  // The plane x + y + z = 1, and a point with an exact sum just beside it.
  const Vec3 on(0.5, 0.25, 0.25);
  const Vec3 above(0.5, 0.25, std::nextafter(0.25, 1.0)),
      below(0.5, 0.25, std::nextafter(0.25, 0.0));
  EXPECT_EQ(orient3d(kX, kY, kZ, on), 0);
  EXPECT_EQ(orient3d(kX, kY, kZ, above), 1);
  EXPECT_EQ(orient3d(kX, kY, kZ, below), -1);
}

TEST(Orient3d, EveryScaleFromDenormalToHuge) {
  for (double scale : {test::kSmallestDouble, 1e-320, 0x1p-1022, 1e-160, 1e-104, 1e-9, 1e9, 1e100,
                       1e160, test::kLargestDouble}) {
    const Vec3 x = scale * kX, y = scale * kY, z = scale * kZ;
    EXPECT_EQ(orient3d(kOrigin, x, y, z), 1) << scale;
    EXPECT_EQ(orient3d(x, y, z, kOrigin), -1) << scale;
    EXPECT_EQ(orient3d(x, y, z, x), 0) << scale;
    EXPECT_EQ(orient3d(-x, x, y, z), 1) << scale;  // the difference overflows at the largest scale
  }
}

TEST(Orient3d, DenormalOffsetBesideTheLargestCoordinates) {
  const Vec3 a(-test::kLargestDouble, -test::kLargestDouble, 0),
      b(test::kLargestDouble, -test::kLargestDouble, 0), c(0, test::kLargestDouble, 0);
  EXPECT_EQ(orient3d(a, b, c, Vec3(0, 0, test::kSmallestDouble)), 1);
  EXPECT_EQ(orient3d(a, b, c, Vec3(0, 0, -test::kSmallestDouble)), -1);
  EXPECT_EQ(orient3d(a, b, c, Vec3(1, 2, 0)), 0);
}

TEST(Orient3d, AllThreeAxesAtBothEndsOfTheRange) {
  // Nothing to strip: the widest determinant there is. x + y + z = test::kLargestDouble and a
  // denormal beside it.
  const Vec3 a(test::kLargestDouble, test::kSmallestDouble, test::kSmallestDouble),
      b(test::kSmallestDouble, test::kLargestDouble, test::kSmallestDouble);
  const Vec3 c(test::kSmallestDouble, test::kSmallestDouble, test::kLargestDouble),
      d(-test::kLargestDouble, -test::kLargestDouble, -test::kLargestDouble);
  EXPECT_EQ(orient3d(a, b, c, d), -1);
  EXPECT_EQ(orient3d(a, c, b, d), 1);
}

TEST(Orient3d, UnderflowingProductsAreNotTrusted) {
  // The products cancel in doubles (both underflow to the same value), not in exact arithmetic.
  const double t = 0x1p-538;
  const Vec3 b(t, t, 0), c(t, t * (1 + 0x1p-40), 0);
  EXPECT_EQ(orient3d(kOrigin, b, c, kZ), 1);
  EXPECT_EQ(orient3d(kOrigin, c, b, kZ), -1);
  EXPECT_EQ(orient2d(kOrigin, b, c, 2), 1);
}

TEST(Orient3d, UnderflowTimesAHugeDifferenceIsNotTrusted) {
  // In doubles one product of the first minor underflows to 2^-1074 and the other to 0; times
  // 2^1000 that outweighs the true value, which is about -2^-80.
  const Vec3 b(0, 0x1p-537, 0x1p-538);
  const Vec3 c(0x1p994, 0x1p-537 * (1 - 0x1p-22), 0x1p-538 * (1 + 0x1p-22));
  const Vec3 d(0x1p1000, 0, 0x1p-537);
  EXPECT_EQ(orient3d(kOrigin, b, c, d), -1);
  EXPECT_EQ(orient3d(kOrigin, c, b, d), 1);
}

TEST(Orient3d, OddPermutationsFlipTheSign) {
  test::TriangleSource source(21);
  int zeros = 0;
  for (int i = 0; i < 3000; ++i) {
    const TrianglePoints t = source.grid_triangle(2);
    const Vec3 d = i % 2 == 0 ? source.grid_point(2) : source.point_near_feature(t);
    const int sign = orient3d(t[0], t[1], t[2], d);
    zeros += sign == 0;
    EXPECT_EQ(orient3d(t[1], t[0], t[2], d), -sign);
    EXPECT_EQ(orient3d(t[1], t[2], t[0], d), sign);
    EXPECT_EQ(orient3d(t[0], t[1], d, t[2]), -sign);
    EXPECT_EQ(orient3d(d, t[0], t[1], t[2]), -sign);
    EXPECT_EQ(orient3d(t[1], t[0], d, t[2]), sign);
  }
  EXPECT_GT(zeros, 300);
  EXPECT_LT(zeros, 2000);
}

TEST(Orient3d, FilterAndExactPathAgree) {
  test::TriangleSource source(22);
  for (int i = 0; i < 3000; ++i) {
    const double radius = std::ldexp(1.0, source.below(700) - 350);
    const TrianglePoints t = source.triangle(Vec3::Zero(), radius);
    const Vec3 d = i % 2 == 0 ? source.point(t[0], radius) : source.point_near_feature(t);
    ASSERT_EQ(orient3d(t[0], t[1], t[2], d), orient3d_exact(t[0], t[1], t[2], d)) << radius;
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_EQ(orient2d(t[0], t[1], d, axis), orient2d_exact(t[0], t[1], d, axis)) << radius;
  }
}

TEST(Orient3d, GenericPointsNeverTakeTheExactPath) {
  test::TriangleSource source(23);
  reset_exact_predicate_calls();
  int positive = 0;
  for (int i = 0; i < 1000; ++i) {
    const TrianglePoints t = source.triangle(Vec3(1e6, -1e6, 1e6), 1.0);
    positive += orient3d(t[0], t[1], t[2], t[0] + Vec3(1, 2, 3)) > 0;
  }
  EXPECT_EQ(exact_predicate_calls(), 0u);
  EXPECT_GT(positive, 300);
  EXPECT_LT(positive, 700);
}

TEST(Orient3d, AxisAlignedPlanesNeedNoExactArithmetic) {
  reset_exact_predicate_calls();
  EXPECT_EQ(orient3d(Vec3(1, 2, .1), Vec3(3, 7, .1), Vec3(-2, 5, .1), Vec3(4, 4, .1)), 0);
  EXPECT_EQ(orient2d(Vec3(1, .1, 0), Vec3(3, .1, 0), Vec3(-2, .1, 0), 2), 0);
  EXPECT_EQ(exact_predicate_calls(), 0u);
}

TEST(ExactPredicateCalls, CountsAndResets) {
  reset_exact_predicate_calls();
  EXPECT_EQ(orient3d(kX, kY, kZ, Vec3(0.5, 0.25, 0.25)), 0);
  EXPECT_EQ(exact_predicate_calls(), 1u);
  EXPECT_EQ(orient2d(kOrigin, Vec3(1, 1, 0), Vec3(2, 2, 0), 2), 0);
  EXPECT_EQ(exact_predicate_calls(), 2u);
  reset_exact_predicate_calls();
  EXPECT_EQ(exact_predicate_calls(), 0u);
}

TEST(Orient2d, KeepsTheTwoCoordinatesAfterTheAxis) {
  EXPECT_EQ(orient2d(kOrigin, kX, kY, 2), 1);
  EXPECT_EQ(orient2d(kOrigin, kY, kZ, 0), 1);
  EXPECT_EQ(orient2d(kOrigin, kZ, kX, 1), 1);
  EXPECT_EQ(orient2d(kOrigin, kY, kX, 2), -1);
  EXPECT_EQ(orient2d(kOrigin, kX, kY, 0), 0);
}

TEST(Orient2d, ClassicNearCollinearPointsAroundOneHalf) {
  // Kettner et al., "Classroom examples of robustness problems": doubles misjudge this line.
  const Vec3 b(12, 12, 0), c(24, 24, 0);
  const double ulp = 0x1p-53;
  for (int i = 0; i < 32; ++i)
    for (int j = 0; j < 32; ++j)
      EXPECT_EQ(orient2d(Vec3(0.5 + i * ulp, 0.5 + j * ulp, 0), b, c, 2), (j > i) - (j < i));
}

TEST(Orient2d, EveryScaleFromDenormalToHuge) {
  for (double scale :
       {test::kSmallestDouble, 1e-320, 1e-160, 1e-9, 1e9, 1e160, test::kLargestDouble}) {
    EXPECT_EQ(orient2d(kOrigin, scale * kX, scale * kY, 2), 1) << scale;
    EXPECT_EQ(orient2d(-scale * kX, scale * kX, scale * kY, 2), 1) << scale;
    EXPECT_EQ(orient2d(scale * kY, scale * kX, -scale * kX, 2), -1) << scale;
  }
}

TEST(Orient2d, RoundedDifferencesWithUnderflowingProductsAreNotTrusted) {
  // p q = 1 + 2^-78. In doubles both differences along x lose the 2^-600, one product rounds up to
  // 2^-1074 and the other, a tie, to 0. The true value is 2^-1075 (2^-78 - 2^-63) < 0, about.
  const double p = 1 + 0x1p-26, q = 1 - 0x1p-26 + 0x1p-52;
  const Vec3 a(0x1p-600, 0, 0), b(0x1p-538 * p, 0x1p-538, 0), c(0x1p-537, 0x1p-537 * q, 0);
  EXPECT_EQ(orient2d(a, b, c, 2), -1);
  EXPECT_EQ(orient2d(a, c, b, 2), 1);
}

TEST(Collinear, OnLinesPointsAndOneUlpBeside) {
  EXPECT_TRUE(collinear(Vec3(1, 2, 3), Vec3(2, 4, 6), Vec3(-3, -6, -9)));
  EXPECT_TRUE(collinear(kX, kX, kY));
  EXPECT_TRUE(collinear(kX, kX, kX));
  EXPECT_FALSE(collinear(Vec3(1, 2, 3), Vec3(2, 4, 6), Vec3(-3, -6, std::nextafter(-9.0, 0.0))));
  EXPECT_FALSE(collinear(kOrigin, kX, Vec3(5, 0, test::kSmallestDouble)));
}

}  // namespace
}  // namespace contactcheck
