// core/narrow against the rational judge, on generic, grid and off-by-ulps input.

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "core/narrow/predicates.h"
#include "core/narrow/triangle_box.h"
#include "core/narrow/triangle_triangle.h"
#include "reference/oracle/rational_geometry.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

/// Pasteable: hexadecimal floating point keeps every bit.
std::string describe(const TrianglePoints& t) {
  std::ostringstream out;
  out << std::hexfloat;
  for (const Vec3& c : t) out << "Vec3(" << c.x() << ", " << c.y() << ", " << c.z() << "), ";
  return out.str();
}

/// Compares one pair; returns the true answer.
bool check_triangles(const TrianglePoints& p, const TrianglePoints& q) {
  const bool expected = oracle::rational::triangles_intersect(p, q);
  EXPECT_EQ(triangles_intersect(p, q), expected) << describe(p) << '\n' << describe(q);
  return expected;
}

bool check_box(const TrianglePoints& t, const Aabb& box) {
  const bool expected = oracle::rational::triangle_meets_box(t, box);
  EXPECT_EQ(triangle_meets_box(t, box), expected) << describe(t) << '\n'
                                                  << describe({box.lo, box.hi, Vec3::Zero()});
  return expected;
}

/// Coordinates of quite different magnitude, denormal and huge ones among them.
Vec3 wild_point(TriangleSource& source) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) {
    const int exponents[] = {-1074, -1070, -540, -300, 0, 0, 300, 540, 1022, 1023};
    p[axis] = std::ldexp(source.below(9) - 4, exponents[source.below(10)] - 2);
  }
  return p;
}

TrianglePoints wild_triangle(TriangleSource& source) {
  return {wild_point(source), wild_point(source), wild_point(source)};
}

TEST(PredicatesAgainstRational, GridWildAndNearDegeneratePoints) {
  TriangleSource source(61);
  int zeros = 0;
  for (int i = 0; i < 6000; ++i) {
    const TrianglePoints t = i % 3 == 0   ? source.grid_triangle(2)
                             : i % 3 == 1 ? wild_triangle(source)
                                          : source.triangle(Vec3(5, 6, 7), 1.0);
    const Vec3 d = i % 3 == 0   ? source.grid_point(2)
                   : i % 3 == 1 ? wild_point(source)
                                : source.point_near_feature(t);
    const int expected = oracle::rational::orient3d(t[0], t[1], t[2], d);
    zeros += expected == 0;
    ASSERT_EQ(orient3d(t[0], t[1], t[2], d), expected) << describe(t) << describe({d, d, d});
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_EQ(orient2d(t[0], t[1], d, axis), oracle::rational::orient2d(t[0], t[1], d, axis))
          << describe(t) << describe({d, d, d});
  }
  EXPECT_GT(zeros, 600);
  EXPECT_LT(zeros, 3000);
}

TEST(TrianglesIntersectAgainstRational, SmallIntegerGrid) {
  TriangleSource source(62);
  int hits = 0;
  for (int i = 0; i < 24000; ++i)
    hits += check_triangles(source.grid_triangle(2), source.grid_triangle(2));
  EXPECT_GT(hits, 4000);
  EXPECT_LT(hits, 16000);
}

TEST(TrianglesIntersectAgainstRational, TinyGridIsDegenerateMostly) {
  TriangleSource source(63);
  int hits = 0;
  for (int i = 0; i < 3000; ++i)
    hits += check_triangles(source.grid_triangle(1), source.grid_triangle(1));
  EXPECT_GT(hits, 900);
  EXPECT_LT(hits, 2400);
}

/// All in one plane; the plane is tilted by a shear for half of them.
TEST(TrianglesIntersectAgainstRational, CoplanarGrid) {
  TriangleSource source(64);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    TrianglePoints p = source.grid_triangle(3), q = source.grid_triangle(3);
    const int tilt = source.below(3), axis = source.below(3);
    for (TrianglePoints* t : {&p, &q})
      for (Vec3& c : *t) c[axis] = tilt * c[(axis + 1) % 3] - c[(axis + 2) % 3];
    hits += check_triangles(p, q);
  }
  EXPECT_GT(hits, 600);
  EXPECT_LT(hits, 1600);
}

TEST(TrianglesIntersectAgainstRational, RandomDoubles) {
  TriangleSource source(65);
  int hits = 0;
  for (int i = 0; i < 10000; ++i)
    hits += check_triangles(source.triangle(Vec3::Zero(), 1.0), source.triangle(Vec3::Zero(), 1.0));
  EXPECT_GT(hits, 1600);
  EXPECT_LT(hits, 4800);
}

TEST(TrianglesIntersectAgainstRational, OffByUlps) {
  TriangleSource source(66);
  int hits = 0;
  for (int i = 0; i < 10000; ++i) {
    const TrianglePoints p = source.triangle(Vec3(1, -2, 3), 1.0);
    hits += check_triangles(p, source.near_degenerate_partner(p, 1.0));
  }
  EXPECT_GT(hits, 2400);
  EXPECT_LT(hits, 7600);
}

TEST(TrianglesIntersectAgainstRational, WildMagnitudes) {
  TriangleSource source(67);
  int hits = 0;
  for (int i = 0; i < 1500; ++i)
    hits += check_triangles(wild_triangle(source), wild_triangle(source));
  EXPECT_GT(hits, 50);
  EXPECT_LT(hits, 1200);
}

TEST(TriangleMeetsBoxAgainstRational, SmallIntegerGrid) {
  TriangleSource source(71);
  int hits = 0;
  for (int i = 0; i < 24000; ++i) hits += check_box(source.grid_triangle(2), source.grid_box(2));
  EXPECT_GT(hits, 6000);
  EXPECT_LT(hits, 18000);
}

TEST(TriangleMeetsBoxAgainstRational, RandomDoubles) {
  TriangleSource source(72);
  int hits = 0;
  for (int i = 0; i < 10000; ++i)
    hits += check_box(source.triangle(Vec3::Zero(), 1.0), source.box(Vec3(0.3, 0.2, 0.1), 0.8));
  EXPECT_GT(hits, 2400);
  EXPECT_LT(hits, 7600);
}

/// One corner of the box is near the triangle's plane, edge or corner.
TEST(TriangleMeetsBoxAgainstRational, OffByUlps) {
  TriangleSource source(73);
  int hits = 0;
  for (int i = 0; i < 8000; ++i) {
    const TrianglePoints t = source.triangle(Vec3(1, -2, 3), 1.0);
    Aabb box;
    const Vec3 corner = source.point_near_feature(t);
    box.extend(corner);
    box.extend(source.below(4) == 0 ? corner : source.point(corner, 0.5));
    hits += check_box(t, box);
  }
  EXPECT_GT(hits, 2000);
  EXPECT_LT(hits, 6800);
}

TEST(TriangleMeetsBoxAgainstRational, WildMagnitudes) {
  TriangleSource source(74);
  int hits = 0;
  for (int i = 0; i < 1500; ++i) {
    Aabb box;
    box.extend(wild_point(source));
    box.extend(wild_point(source));
    hits += check_box(wild_triangle(source), box);
  }
  EXPECT_GT(hits, 100);
  EXPECT_LT(hits, 1400);
}

}  // namespace
}  // namespace contactcheck::test
