// The triangle test in single precision: against the exact one where nothing is close, and what it
// promises everywhere.
#include <gtest/gtest.h>

#include <cmath>

#include "core/narrow/predicates_single.h"
#include "core/narrow/triangle_triangle.h"
#include "core/types/local_origin.h"
#include "tests/support/random_triangles.h"

namespace contactcheck {
namespace {

using Singles = TrianglePointsOf<float>;

Singles singles(const TrianglePoints& t) {
  return {t[0].cast<float>(), t[1].cast<float>(), t[2].cast<float>()};
}

TrianglePoints doubles(const Singles& t) {
  return {t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>()};
}

// Coordinates of few bits: every determinant is exact in floats, so the answers must be equal,
// touching and degenerate triangles included.
TEST(SingleTriangles, AreExactOnASmallGrid) {
  test::TriangleSource source(11);
  int meet = 0;
  for (int i = 0; i < 200000; ++i) {
    const TrianglePoints p = source.grid_triangle(4), q = source.grid_triangle(4);
    const bool exact = triangles_intersect(p, q);
    ASSERT_EQ(triangles_intersect(singles(p), singles(q)), exact) << i;
    meet += exact;
  }
  EXPECT_GT(meet, 20000);
  EXPECT_LT(meet, 180000);
}

TEST(SingleTriangles, AgreeWithTheExactTestButForOneInAThousand) {
  test::TriangleSource source(12);
  int meet = 0, differ = 0;
  for (int i = 0; i < 200000; ++i) {
    const Singles p = singles(source.triangle(Vec3::Zero(), 1.0));
    const Singles q = singles(source.triangle(Vec3::Zero(), 1.0));
    const bool exact = triangles_intersect(doubles(p), doubles(q));
    meet += exact;
    differ += triangles_intersect(p, q) != exact;
  }
  EXPECT_GT(meet, 20000);
  EXPECT_LT(differ, 20);
}

TEST(SingleTriangles, TouchingIsContact) {
  const Singles base = {Vec3f(0, 0, 0), Vec3f(4, 0, 0), Vec3f(0, 4, 0)};
  EXPECT_TRUE(triangles_intersect(base, Singles{Vec3f(4, 0, 0), Vec3f(6, 1, 3), Vec3f(7, -1, 2)}));
  EXPECT_TRUE(triangles_intersect(base, Singles{Vec3f(1, 1, 0), Vec3f(1, 2, 3), Vec3f(2, 1, 3)}));
  EXPECT_TRUE(triangles_intersect(base, Singles{Vec3f(2, 0, -1), Vec3f(2, 0, 1), Vec3f(2, -3, 2)}));
  EXPECT_TRUE(triangles_intersect(base, Singles{Vec3f(1, 1, 0), Vec3f(9, 1, 0), Vec3f(9, 2, 0)}));
  EXPECT_FALSE(triangles_intersect(base, Singles{Vec3f(1, 1, 1), Vec3f(1, 2, 3), Vec3f(2, 1, 3)}));
}

// At the limit the largest determinant is 48 * 2^120: finite, and the sign is right.
TEST(SingleOrient3d, IsFiniteAtTheLimit) {
  const float x = kSingleLimit;
  const Vec3f a(-x, -x, -x), b(x, -x, -x), c(-x, x, -x), d(-x, -x, x);
  EXPECT_EQ(orient3d(a, b, c, d), 1);
  EXPECT_EQ(orient3d(a, c, b, d), -1);
  EXPECT_EQ(orient3d(a, b, c, Vec3f(x, x, -x)), 0);
  EXPECT_EQ(orient3d(Vec3f(x, x, -x), Vec3f(-x, x, x), Vec3f(x, -x, x), Vec3f(-x, -x, -x)), -1);
}

}  // namespace
}  // namespace contactcheck
