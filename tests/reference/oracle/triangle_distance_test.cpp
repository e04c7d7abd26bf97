#include "reference/oracle/triangle_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/oracle/rational_geometry.h"
#include "tests/reference/oracle/meshes.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

using oracle::DistanceBounds;
using Triangle3 = oracle::TriangleCorners;

// lower^2 <= squared <= upper^2, exactly.
bool holds(const DistanceBounds& bounds, const mpq_class& squared) {
  const mpq_class low(bounds.lower), high(bounds.upper);
  return low * low <= squared && squared <= high * high;
}

// Checks both versions against the truth; returns the width in double.
double check_bounds(const Triangle3& p, const Triangle3& q) {
  const mpq_class squared = oracle::rational::squared_distance(p, q);
  const DistanceBounds fast = oracle::distance_bounds(p, q);
  const DistanceBounds exact = oracle::exact_distance_bounds(p, q);
  EXPECT_TRUE(holds(fast, squared)) << hex_points(p) << '\n' << hex_points(q);
  EXPECT_TRUE(holds(exact, squared)) << hex_points(p) << '\n' << hex_points(q);
  EXPECT_EQ(exact.upper == 0, squared == 0);
  EXPECT_LE(exact.upper - exact.lower, 0x1p-50 * exact.upper + 2e-154);
  return fast.upper - fast.lower;
}

TEST(TriangleDistance, KnownValues) {
  const Triangle3 p{Vec3(0, 0, 0), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0)};
  const auto expect = [&](const Triangle3& q, double distance) {
    for (const DistanceBounds& b :
         {oracle::distance_bounds(p, q), oracle::exact_distance_bounds(p, q)}) {
      EXPECT_LE(b.lower, distance);
      EXPECT_GE(b.upper, distance);
      EXPECT_LT(b.upper - b.lower, 1e-12);
    }
  };
  expect({Vec3(0.125, 0.125, 0.25), Vec3(0, 0, 1), Vec3(0.5, 0.5, 1)}, 0.25);   // corner, face
  expect({Vec3(-0.5, 0.25, -1), Vec3(-0.5, 0.25, 1), Vec3(-1, 0, 0)}, 0.5);     // edge, edge
  expect({Vec3(-0.375, -0.5, 0), Vec3(-1, -1, 0), Vec3(-1, -0.75, 0)}, 0.625);  // corners
  expect({Vec3(0.125, 0.125, 0.75), Vec3(0.125, 0.125, 0.75), Vec3(0.125, 0.125, 0.75)}, 0.75);
}

TEST(TriangleDistance, TouchingIsZeroExactly) {
  const Triangle3 p{Vec3(0, 0, 0), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0)};
  const Triangle3 q{Vec3(0.25, 0.25, 0), Vec3(1, 1, 1), Vec3(1, 1, 0.5)};
  const DistanceBounds exact = oracle::exact_distance_bounds(p, q);
  EXPECT_EQ(exact.lower, 0.0);
  EXPECT_EQ(exact.upper, 0.0);
  EXPECT_EQ(oracle::distance_bounds(p, q).lower, 0.0);
}

TEST(TriangleDistance, SmallestGapIsNotZero) {
  const Triangle3 p{Vec3(0, 0, 0), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0)};
  Triangle3 q = p;
  for (Vec3& c : q) c.z() = 0x1p-1074;
  const DistanceBounds exact = oracle::exact_distance_bounds(p, q);
  EXPECT_GT(exact.upper, 0.0);
  EXPECT_LT(exact.upper, 1e-150);
}

TEST(TriangleDistanceAgainstRational, RandomPairsAreNarrow) {
  TriangleSource source(501);
  int narrow = 0;
  for (int i = 0; i < 700; ++i) {
    const Triangle3 p = source.triangle(Vec3(-0.5, 0, 0), 0.5);
    narrow += check_bounds(p, source.triangle(Vec3(0.5, 0, 0), 0.5)) < 1e-12;
  }
  EXPECT_GT(narrow, 690);
}

TEST(TriangleDistanceAgainstRational, GridPairsDegenerateAmongThem) {
  TriangleSource source(502);
  int narrow = 0;
  for (int i = 0; i < 1200; ++i) {
    Triangle3 p = source.grid_triangle(2), q = source.grid_triangle(2);
    for (Triangle3* t : {&p, &q})
      for (Vec3& c : *t) c *= 0.5;
    narrow += check_bounds(p, q) < 1e-12;
  }
  EXPECT_GT(narrow, 600);  // touching pairs have no slab, yet are 1e-13 wide
}

// Gaps from 1e-3 down to 1e-15 between near-degenerate partners.
TEST(TriangleDistanceAgainstRational, NearlyTouching) {
  TriangleSource source(503);
  for (int i = 0; i < 700; ++i) {
    const Triangle3 p = source.triangle(Vec3::Zero(), 0.4);
    Triangle3 q = source.near_degenerate_partner(p, 0.2);
    const Vec3 shift = source.point(Vec3::Zero(), std::ldexp(1.0, -10 - source.below(40)));
    for (Vec3& c : q) c = (0.4 * c + shift).eval();
    check_bounds(p, q);
  }
}

TEST(TriangleDistanceAgainstRational, TinyTriangles) {
  TriangleSource source(504);
  for (double scale : {1e-100, 1e-160, 1e-300, 1e-320}) {
    for (int i = 0; i < 60; ++i) {
      const Triangle3 p = source.triangle(Vec3::Zero(), scale);
      check_bounds(p, source.triangle(Vec3(scale, 0, 0), scale));
    }
  }
}

}  // namespace
}  // namespace contactcheck::test
