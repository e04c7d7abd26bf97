// Neighbours without area: segments and points, which shared edges and corners do not tell. All
// others are held against rational arithmetic (tests/reference/oracle).
#include "core/narrow/adjacent_triangles.h"

#include <gtest/gtest.h>

namespace contactcheck {
namespace {

Vec3 at(double x) { return {x, 2.0 * x, -x}; }  // on a line through 0

TEST(MeetBeyondCorner, OfSegmentsFromItIsByTheirDirections) {
  const Vec3 c = at(0);
  // Corners in both orders; one of them is the shared corner again, or on the way to the other.
  for (const double part : {0.0, 0.5})
    for (const bool p_turned : {false, true})
      for (const bool q_turned : {false, true}) {
        const auto meet = [&](double p, double q) {
          const Vec3 p1 = at(p), p2 = at(0), q1 = at(q), q2 = at(part * q);
          return meet_beyond_corner(c, p_turned ? p2 : p1, p_turned ? p1 : p2, q_turned ? q2 : q1,
                                    q_turned ? q1 : q2);
        };
        EXPECT_TRUE(meet(1, 2));
        EXPECT_TRUE(meet(-2, -1));
        EXPECT_FALSE(meet(1, -2));
        EXPECT_FALSE(meet(-2, 1));
        EXPECT_FALSE(meet(0, 1));
      }
}

TEST(MeetBeyondEdge, OfSegmentsIsByTheEndThatBothPass) {
  for (const auto& [a, b] : {std::pair(at(0), at(1)), std::pair(at(1), at(0))}) {
    EXPECT_TRUE(meet_beyond_edge(a, b, at(-1), at(-2)));
    EXPECT_TRUE(meet_beyond_edge(a, b, at(3), at(2)));
    EXPECT_FALSE(meet_beyond_edge(a, b, at(-1), at(2)));
    EXPECT_FALSE(meet_beyond_edge(a, b, at(0.5), at(0.25)));
    EXPECT_FALSE(meet_beyond_edge(a, b, at(2), at(1)));
  }
}

}  // namespace
}  // namespace contactcheck
