// The triangle test of floats: their exact answer.
#include <gtest/gtest.h>

#include "core/narrow/triangle_triangle.h"
#include "tests/support/random_triangles.h"

namespace contactcheck {
namespace {

using Singles = TrianglePointsOf<float>;

Singles singles(const TrianglePoints& t) {
  return {t[0].cast<float>(), t[1].cast<float>(), t[2].cast<float>()};
}

TEST(SingleTriangles, AnswerAsTheSameNumbersInDoubles) {
  test::TriangleSource source(11);
  int meet = 0;
  for (int i = 0; i < 20000; ++i) {
    const TrianglePoints p = source.grid_triangle(4), q = source.grid_triangle(4);
    const bool exact = triangles_intersect(p, q);
    ASSERT_EQ(triangles_intersect(singles(p), singles(q)), exact) << i;
    meet += exact;
  }
  EXPECT_GT(meet, 2000);
  EXPECT_LT(meet, 18000);
}

TEST(SingleTriangles, TouchingIsContact) {
  const Singles base = {Vec3f(0, 0, 0), Vec3f(4, 0, 0), Vec3f(0, 4, 0)};
  EXPECT_TRUE(triangles_intersect(base, Singles{Vec3f(1, 1, 0), Vec3f(1, 2, 3), Vec3f(2, 1, 3)}));
  EXPECT_FALSE(
      triangles_intersect(base, Singles{Vec3f(1, 1, 0x1p-20f), Vec3f(1, 2, 3), Vec3f(2, 1, 3)}));
}

// Nearly in one plane and a tenth of their size apart within it: determinants in floats are noise
// there, and their signs would say that the triangles meet.
TEST(SingleTriangles, InOneTiltedPlaneAreApartWhenTheyAre) {
  const Singles p = {Vec3f(-0x1.6ee2bep-1f, -0x1.1f32eep+0f, -0x1.8ed98cp-3f),
                     Vec3f(0x1.35b772p-1f, 0x1.2c068ep+0f, 0x1.0ffdcep-2f),
                     Vec3f(-0x1.1dd882p+0f, 0x1.00887ep-1f, 0x1.6ad52ep-1f)};
  EXPECT_FALSE(triangles_intersect(p, Singles{-p[0], -p[1], -p[2]}));
}

}  // namespace
}  // namespace contactcheck
