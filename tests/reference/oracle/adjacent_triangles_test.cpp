// Triangles that share a corner or an edge: core's predicates and the oracle's against the
// definition in rational arithmetic, which shares no line of code with either.

#include "core/narrow/adjacent_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "reference/oracle/exact_tests.h"
#include "reference/oracle/frame_certificate.h"
#include "reference/oracle/rational_clipping.h"
#include "tests/support/random_triangles.h"
#include "tests/support/range_ends.h"

namespace contactcheck::test {
namespace {

/// Two triangles of one mesh whose first `shared` corners are the same.
struct Neighbours {
  std::uint32_t shared;
  TrianglePoints p, q;
};

bool by_core(const Neighbours& n) {
  return n.shared == 1 ? meet_beyond_corner(n.p[0], n.p[1], n.p[2], n.q[1], n.q[2])
                       : meet_beyond_edge(n.p[0], n.p[1], n.p[2], n.q[2]);
}

bool by_oracle(const Neighbours& n) {
  return n.shared == 1 ? oracle::meet_beyond_corner(n.p, n.q) : oracle::meet_beyond_edge(n.p, n.q);
}

bool by_definition(const Neighbours& n) {
  return oracle::rational::share_more_than(n.p[0], n.p[n.shared - 1], n.p, n.q);
}

/// By the proofs that an export has: there is one of either kind alone.
bool by_proof(const Neighbours& n) {
  const bool segments =
      oracle::collinear(n.p[0], n.p[1], n.p[2]) && oracle::collinear(n.q[0], n.q[1], n.q[2]);
  const bool alone = n.shared == 2 || segments
                         ? oracle::certify::share_hull_alone(n.p, n.q, n.shared)
                         : oracle::certify::plane_through_corner(n.p, n.q).has_value();
  const bool further = oracle::certify::further_point(n.p, n.q, n.shared).has_value();
  EXPECT_NE(alone, further);
  return further;
}

/// The same two triangles: exchanged, and the other corners of either in the other order.
Neighbours relabelled(Neighbours n, int how) {
  if ((how & 1) != 0) std::swap(n.p, n.q);
  if ((how & 2) != 0 && n.shared == 1) std::swap(n.p[1], n.p[2]);
  if ((how & 4) != 0 && n.shared == 1) std::swap(n.q[1], n.q[2]);
  if ((how & 2) != 0 && n.shared == 2) {
    std::swap(n.p[0], n.p[1]);
    std::swap(n.q[0], n.q[1]);
  }
  return n;
}

bool agreed(const Neighbours& n) {
  const bool truth = by_definition(n);
  EXPECT_EQ(by_oracle(n), truth);
  EXPECT_EQ(by_core(n), truth);
  EXPECT_EQ(by_proof(n), truth);
  for (int how = 1; how < 8; ++how) {
    EXPECT_EQ(by_core(relabelled(n, how)), truth) << "relabelled " << how;
    EXPECT_EQ(by_oracle(relabelled(n, how)), truth) << "relabelled " << how;
  }
  return truth;
}

bool meet_at(const Vec3& c, const Vec3& p1, const Vec3& p2, const Vec3& q1, const Vec3& q2) {
  return agreed({1, {c, p1, p2}, {c, q1, q2}});
}
bool meet_along(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
  return agreed({2, {a, b, p}, {a, b, q}});
}

const Vec3 kO = Vec3::Zero(), kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

TEST(AdjacentTriangles, AtACornerThatIsAllTheyShare) {
  EXPECT_FALSE(meet_at(kO, kX, kY, -kX, -kY));
  EXPECT_FALSE(meet_at(kO, kX, kY, Vec3(1, 1, 1), Vec3(1, 2, 3)));
  EXPECT_FALSE(meet_at(kO, kX, kY, Vec3(-1, -1, -1), Vec3(-1, -1, 1))) << "beyond the corner";
}

TEST(AdjacentTriangles, ThatCrossBeyondTheirCorner) {
  EXPECT_TRUE(meet_at(kO, kX, kY, Vec3(0.3, 0.3, -1), Vec3(0.3, 0.3, 1)));
  EXPECT_TRUE(meet_at(kO, kX, kY, Vec3(9, 9, -1), Vec3(9, 9, 1))) << "however long";
  EXPECT_TRUE(meet_at(kO, kX, kY, Vec3(1, 0, -1), Vec3(1, 0, 1))) << "along an edge";
  EXPECT_FALSE(meet_at(kO, kX, kY, Vec3(1, -kSmallestDouble, -1), Vec3(1, -kSmallestDouble, 1)));
  EXPECT_TRUE(meet_at(kO, kX, kY, Vec3(1, 1, 0), kZ)) << "one edge lies in the other";
}

TEST(AdjacentTriangles, InOnePlane) {
  EXPECT_TRUE(meet_at(kO, kX, kY, Vec3(2, 1, 0), Vec3(1, 2, 0)));
  EXPECT_TRUE(meet_at(kO, kX, kY, Vec3(1, 1, 0), Vec3(1, -1, 0)));
  EXPECT_TRUE(meet_at(kO, kX, kY, kY, -kX)) << "edge on edge";
  EXPECT_FALSE(meet_at(kO, kX, kY, Vec3(-kSmallestDouble, 1, 0), -kX));
  EXPECT_TRUE(meet_at(kO, kX, kY, Vec3(-1, 2, 0), Vec3(2, -1, 0))) << "one holds the other";
}

TEST(AdjacentTriangles, DegenerateAtTheirCorner) {
  EXPECT_TRUE(meet_at(kO, kX, kY, Vec3(1, 1, 0), Vec3(2, 2, 0))) << "a segment into a triangle";
  EXPECT_FALSE(meet_at(kO, kX, kY, Vec3(-1, -1, 0), Vec3(-2, -2, 0)));
  EXPECT_TRUE(meet_at(kO, kX, kY, Vec3(-1, -1, 0), Vec3(1, 1, 0))) << "through the corner";
  EXPECT_TRUE(meet_at(kO, kX, -kX, Vec3(2, 0, 0), kO)) << "a segment on a segment";
  EXPECT_FALSE(meet_at(kO, kX, kX, -kX, kO));
  EXPECT_FALSE(meet_at(kO, kO, kO, kX, kY)) << "a point";
}

TEST(AdjacentTriangles, AtAnEdge) {
  EXPECT_FALSE(meet_along(kO, kX, kY, -kY)) << "flat";
  EXPECT_FALSE(meet_along(kO, kX, kY, kZ));
  EXPECT_FALSE(meet_along(kO, kX, kY, Vec3(0, 1, kSmallestDouble))) << "nearly folded";
  EXPECT_TRUE(meet_along(kO, kX, kY, Vec3(5, 1, 0))) << "folded";
  EXPECT_TRUE(meet_along(kO, kX, kY, kY)) << "duplicates by position";
}

TEST(AdjacentTriangles, DegenerateAtAnEdge) {
  EXPECT_FALSE(meet_along(kO, kX, Vec3(2, 0, 0), kY)) << "a longer segment and a triangle";
  EXPECT_TRUE(meet_along(kO, kX, Vec3(2, 0, 0), Vec3(3, 0, 0)));
  EXPECT_FALSE(meet_along(kO, kX, Vec3(2, 0, 0), Vec3(-1, 0, 0)));
  EXPECT_FALSE(meet_along(kO, kX, Vec3(0.5, 0, 0), Vec3(2, 0, 0)));
  EXPECT_TRUE(meet_along(kO, kO, kX, kX)) << "an edge that is a point";
  EXPECT_TRUE(meet_along(kO, kO, kX, Vec3(2, 0, 0)));
  EXPECT_FALSE(meet_along(kO, kO, kX, -kX));
  EXPECT_FALSE(meet_along(kO, kO, kX, kY));
}

/// Of each kind; a larger number is for a search by hand.
int count_of_each() {
  const char* const text = std::getenv("CONTACTCHECK_ADJACENT_PAIRS");
  return text == nullptr ? 4000 : std::max(1, std::atoi(text));
}

/// Random neighbours of all kinds; gives back how many meet.
int search(std::uint32_t shared, TriangleSource& source) {
  const int count = count_of_each();
  int meeting = 0;
  for (int i = 0; i < 3 * count && !testing::Test::HasFailure(); ++i) {
    Neighbours n;
    n.shared = shared;
    if (i % 3 == 0) {
      n.p = source.triangle(Vec3(1, 2, 3), 1.0);
      n.q = source.triangle(Vec3(1, 2, 3), 1.0);
    } else if (i % 3 == 1) {
      const int limit = 1 + source.below(3);
      n.p = source.grid_triangle(limit);
      n.q = source.grid_triangle(limit);
    } else {
      n.p = source.triangle(Vec3(1, 2, 3), 1.0);
      if (source.below(4) == 0) n.p[2] = source.point_near_feature({n.p[0], n.p[1], n.p[0]});
      n.q = source.near_degenerate_partner(n.p, 1.0);
    }
    for (std::uint32_t c = 0; c < shared; ++c) n.q[c] = n.p[c];
    meeting += agreed(n);
  }
  return meeting;
}

TEST(AdjacentTriangles, RandomCornersAreJudgedByTheDefinition) {
  TriangleSource source(1);
  const int meeting = search(1, source);
  EXPECT_GT(meeting, count_of_each() / 4);
  EXPECT_LT(meeting, 2 * count_of_each());
}

TEST(AdjacentTriangles, RandomEdgesAreJudgedByTheDefinition) {
  TriangleSource source(2);
  const int meeting = search(2, source);
  EXPECT_GT(meeting, count_of_each() / 20);
  EXPECT_LT(meeting, 2 * count_of_each());
}

}  // namespace
}  // namespace contactcheck::test
