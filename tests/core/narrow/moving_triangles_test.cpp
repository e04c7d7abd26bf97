// Tests that see moving triangles apart, against exact tests of their elements.

#include "core/narrow/moving_triangles.h"

#include <gtest/gtest.h>

#include "tests/core/narrow/moving_triangle_errors.h"

namespace contactcheck {
namespace {

using test::Separations;
using test::TriangleSource;

// A half of the error does not hold.
TEST(MovingTriangles, ErrorsOfGapsAreReachedByMoreThanAHalf) {
  test::report_observed_error("gap of moving triangles", test::largest_gap_error(12), 0.5);
}

TEST(MovingTriangles, SeparatedOnesNeverMeetAtAnyScale) {
  const Separations seen = test::judged_separations(3000);
  EXPECT_EQ(seen.wrong, 0);
  EXPECT_EQ(seen.unlike, 0);
  EXPECT_GT(seen.meet, 600);
  EXPECT_GT(seen.separated, seen.apart / 2);
}

// Boxes of whole numbers, at times that are sums of powers of two: exact.
TEST(MovingBoxes, SeparatedOnesAreApartAlongOneAxisAtAllTimes) {
  TriangleSource random(563);
  int separate = 0, other = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto box = [&] {
      const Vec3 at = random.grid_point(2);
      Aabb out = random.grid_box(1);
      out.lo += at, out.hi += at;
      return out;
    };
    const MovingBox a = {box(), box()}, b = {box(), box()};
    bool apart = false;
    for (int k = 0; k < 3; ++k) {
      int below = 0, above = 0;
      for (double t = 0.0; t <= 1.0; t += 0.125) {
        const auto at = [&](const Vec3& start, const Vec3& end) {
          return (1 - t) * start[k] + t * end[k];
        };
        below += at(a.start.hi, a.end.hi) < at(b.start.lo, b.end.lo);
        above += at(b.start.hi, b.end.hi) < at(a.start.lo, a.end.lo);
      }
      apart |= below == 9 || above == 9;
    }
    ASSERT_EQ(separated(a, b), apart);
    ASSERT_EQ(separated(b, a), apart);
    (apart ? separate : other) += 1;
  }
  EXPECT_GT(separate, 500);
  EXPECT_GT(other, 500);
}

}  // namespace
}  // namespace contactcheck
