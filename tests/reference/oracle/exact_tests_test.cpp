#include "reference/oracle/exact_tests.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reference/oracle/rational_geometry.h"
#include "tests/reference/oracle/meshes.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

using oracle::Segment;
using Triangle3 = oracle::TriangleCorners;

const Triangle3 kRightTriangle{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

double above(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

TEST(PointOnTriangle, CornersEdgesAndFaceCount) {
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(1, 1, 0)})
    EXPECT_TRUE(oracle::point_on_triangle(p, kRightTriangle)) << p.transpose();
}

TEST(PointOnTriangle, OneUlpAwayDoesNotCount) {
  EXPECT_FALSE(oracle::point_on_triangle({1, 1, 0x1p-1074}, kRightTriangle));
  EXPECT_FALSE(oracle::point_on_triangle({2, above(2), 0}, kRightTriangle));
  EXPECT_FALSE(oracle::point_on_triangle({1, -0x1p-1074, 0}, kRightTriangle));
}

TEST(PointOnTriangle, DegenerateTriangleIsItsSegmentOrPoint) {
  const Triangle3 segment{Vec3(1, 1, 1), Vec3(3, 3, 3), Vec3(2, 2, 2)};
  EXPECT_TRUE(oracle::point_on_triangle({3, 3, 3}, segment));
  EXPECT_TRUE(oracle::point_on_triangle({1.5, 1.5, 1.5}, segment));
  EXPECT_FALSE(oracle::point_on_triangle({3.5, 3.5, 3.5}, segment));
  EXPECT_FALSE(oracle::point_on_triangle({2, 2, above(2)}, segment));
  const Triangle3 point{Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3)};
  EXPECT_TRUE(oracle::point_on_triangle({1, 2, 3}, point));
  EXPECT_FALSE(oracle::point_on_triangle({1, 2, above(3)}, point));
}

TEST(SegmentsIntersect, CrossingTouchingAndApart) {
  const Segment x{Vec3(0, 0, 0), Vec3(2, 0, 0)};
  EXPECT_TRUE(oracle::segments_intersect(x, {Vec3(1, -1, 0), Vec3(1, 1, 0)}));
  EXPECT_TRUE(oracle::segments_intersect(x, {Vec3(2, 0, 0), Vec3(2, 1, 5)}));
  EXPECT_TRUE(oracle::segments_intersect(x, {Vec3(1, 0, 0), Vec3(1, 1, 0)}));
  EXPECT_FALSE(oracle::segments_intersect(x, {Vec3(1, -1, 1), Vec3(1, 1, 1)}));
  EXPECT_FALSE(oracle::segments_intersect(x, {Vec3(3, -1, 0), Vec3(3, 1, 0)}));
  EXPECT_FALSE(oracle::segments_intersect(x, {Vec3(above(2), 0, 0), Vec3(2, 1, 5)}));
}

TEST(SegmentsIntersect, CollinearOverlapGapAndPoint) {
  const Segment diagonal{Vec3(0, 0, 0), Vec3(2, 2, 2)};
  EXPECT_TRUE(oracle::segments_intersect(diagonal, {Vec3(1, 1, 1), Vec3(3, 3, 3)}));
  EXPECT_TRUE(oracle::segments_intersect(diagonal, {Vec3(3, 3, 3), Vec3(2, 2, 2)}));
  EXPECT_TRUE(oracle::segments_intersect(diagonal, {Vec3(-1, -1, -1), Vec3(5, 5, 5)}));
  EXPECT_FALSE(oracle::segments_intersect(diagonal, {Vec3(2.5, 2.5, 2.5), Vec3(3, 3, 3)}));
  EXPECT_TRUE(oracle::segments_intersect(diagonal, {Vec3(1, 1, 1), Vec3(1, 1, 1)}));
  EXPECT_FALSE(oracle::segments_intersect(diagonal, {Vec3(1, 1, 1.5), Vec3(1, 1, 1.5)}));
}

TEST(SegmentMeetsTriangle, PiercingTouchingCoplanar) {
  const auto meets = [](const Vec3& a, const Vec3& b) {
    return oracle::segment_meets_triangle({a, b}, kRightTriangle);
  };
  EXPECT_TRUE(meets({1, 1, -1}, {1, 1, 1}));
  EXPECT_TRUE(meets({2, 2, -1}, {2, 2, 1}));   // through an edge
  EXPECT_TRUE(meets({4, 0, -1}, {4, 0, 1}));   // through a corner
  EXPECT_TRUE(meets({1, 1, 0}, {1, 1, 1}));    // standing on the face
  EXPECT_TRUE(meets({-1, 1, 0}, {5, 1, 0}));   // coplanar, across
  EXPECT_TRUE(meets({1, 1, 0}, {1.5, 1, 0}));  // coplanar, within
  EXPECT_TRUE(meets({-1, 4, 0}, {1, 4, 0}));   // coplanar, at a corner
  EXPECT_TRUE(meets({5, 0, 0}, {3, 0, 0}));    // along an edge
  EXPECT_FALSE(meets({above(2), 2, -1}, {above(2), 2, 1}));
  EXPECT_FALSE(meets({1, 1, 0x1p-1074}, {1, 1, 1}));
  EXPECT_FALSE(meets({5, 0, 0}, {6, 0, 0}));
  EXPECT_FALSE(meets({3, 3, 0}, {5, 0, 0}));
}

TEST(TrianglesIntersect, TouchingInACornerCounts) {
  const Triangle3 q{Vec3(4, 0, 0), Vec3(5, 1, 1), Vec3(5, -1, 1)};
  EXPECT_TRUE(oracle::triangles_intersect(kRightTriangle, q));
  Triangle3 apart = q;
  apart[0].x() = above(4);
  EXPECT_FALSE(oracle::triangles_intersect(kRightTriangle, apart));
}

TEST(TrianglesIntersect, CoplanarNestedEdgeToEdgeAndApart) {
  EXPECT_TRUE(
      oracle::triangles_intersect(kRightTriangle, {Vec3(1, 1, 0), Vec3(2, 1, 0), Vec3(1, 2, 0)}));
  EXPECT_TRUE(
      oracle::triangles_intersect(kRightTriangle, {Vec3(1, 0, 0), Vec3(3, 0, 0), Vec3(2, -5, 0)}));
  EXPECT_FALSE(
      oracle::triangles_intersect(kRightTriangle, {Vec3(3, 3, 0), Vec3(4, 3, 0), Vec3(4, 4, 0)}));
}

// CGAL 5.5.1 without its assertions reported a contact here.
TEST(TrianglesIntersect, PointOffAFaceDoesNotCount) {
  const Vec3 off(1, 1, 0.1);
  EXPECT_FALSE(oracle::triangles_intersect(kRightTriangle, {off, off, off}));
  EXPECT_FALSE(oracle::triangles_intersect({off, off, off}, kRightTriangle));
  const Vec3 on(1, 1, 0);
  EXPECT_TRUE(oracle::triangles_intersect(kRightTriangle, {on, on, on}));
}

// Compares both orders with the rational answer; returns that.
bool check_pair(const Triangle3& p, const Triangle3& q) {
  const bool expected = oracle::rational::triangles_intersect(p, q);
  EXPECT_EQ(oracle::triangles_intersect(p, q), expected) << hex_points(p) << '\n' << hex_points(q);
  EXPECT_EQ(oracle::triangles_intersect(q, p), expected) << hex_points(q) << '\n' << hex_points(p);
  return expected;
}

struct HitWindow {
  int low, high;
};

template <typename MakePair>
void compare_with_rational(int count, HitWindow window, MakePair&& make_pair) {
  int hits = 0;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const auto [p, q] = make_pair();
    hits += check_pair(p, q);
  }
  EXPECT_GT(hits, window.low);
  EXPECT_LT(hits, window.high);
}

TEST(TrianglesIntersectAgainstRational, GridPairsMostlyDegenerateOrTouching) {
  TriangleSource source(101);
  compare_with_rational(6000, {1000, 5000}, [&] {
    const int limit = 1 + source.below(2);
    const Triangle3 p = source.grid_triangle(limit);
    return std::pair(p, source.grid_triangle(limit));
  });
}

TEST(TrianglesIntersectAgainstRational, CoplanarGridPairs) {
  TriangleSource source(102);
  compare_with_rational(1500, {400, 1300}, [&] {
    Triangle3 p = source.grid_triangle(3), q = source.grid_triangle(3);
    for (Triangle3* t : {&p, &q})
      for (Vec3& c : *t) c.z() = 2 * c.x() - c.y();
    return std::pair(p, q);
  });
}

TEST(TrianglesIntersectAgainstRational, OffByUlps) {
  TriangleSource source(103);
  compare_with_rational(3000, {700, 2500}, [&] {
    const Triangle3 p = source.triangle(Vec3(1, -2, 3), 1.0);
    return std::pair(p, source.near_degenerate_partner(p, 1.0));
  });
}

// A scale at which products underflow, and one at which coordinates themselves are subnormal.
TEST(TrianglesIntersectAgainstRational, TinyAndHugeScales) {
  for (double scale : {1e-160, 1e-300, 0x1p-1073, 1e300}) {
    TriangleSource source(104);
    compare_with_rational(500, {60, 420}, [&] {
      Triangle3 p = source.grid_triangle(3), q = source.grid_triangle(3);
      for (Triangle3* t : {&p, &q})
        for (Vec3& c : *t) c *= scale;
      return std::pair(p, q);
    });
  }
}

TEST(TrianglesIntersectAgainstRational, RandomPairsAtTinyScale) {
  TriangleSource source(105);
  compare_with_rational(600, {60, 500}, [&] {
    const Triangle3 p = source.triangle(Vec3::Zero(), 1e-300);
    return std::pair(p, source.near_degenerate_partner(p, 1e-300));
  });
}

// Coordinates of one triangle from the smallest subnormal number to the largest doubles.
TEST(TrianglesIntersectAgainstRational, WildMagnitudes) {
  TriangleSource source(107);
  const auto triangle = [&] {
    Triangle3 t;
    for (Vec3& p : t)
      for (int axis = 0; axis < 3; ++axis) {
        const int exponents[] = {-1074, -1070, -540, -300, 0, 0, 300, 540, 1022, 1023};
        p[axis] = std::ldexp(source.below(9) - 4, exponents[source.below(10)] - 2);
      }
    return t;
  };
  compare_with_rational(800, {25, 640}, [&] {
    const Triangle3 p = triangle();
    return std::pair(p, triangle());
  });
}

TEST(OrientationAgainstRational, GridUlpsAndTinyScales) {
  TriangleSource source(106);
  int zeros = 0;
  for (int i = 0; i < 3000; ++i) {
    const bool grid = i % 2 == 0;
    const double scale = i % 3 == 0 ? 1.0 : i % 3 == 1 ? 0x1p-540 : 0x1p-1060;
    Triangle3 t = grid ? source.grid_triangle(2) : source.triangle(Vec3(5, 6, 7), 1.0);
    Vec3 d = grid ? source.grid_point(2) : source.point_near_feature(t);
    for (Vec3& c : t) c *= scale;
    d *= scale;
    const int expected = oracle::rational::orient3d(t[0], t[1], t[2], d);
    zeros += expected == 0;
    ASSERT_EQ(oracle::orientation(t[0], t[1], t[2], d), expected) << hex_points(t);
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_EQ(oracle::projected_orientation(t[0], t[1], d, axis),
                oracle::rational::orient2d(t[0], t[1], d, axis))
          << hex_points(t);
  }
  EXPECT_GT(zeros, 300);
  EXPECT_LT(zeros, 2000);
}

}  // namespace
}  // namespace contactcheck::test
