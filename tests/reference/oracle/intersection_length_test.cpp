#include "reference/oracle/intersection_length.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reference/oracle/exact_tests.h"
#include "reference/oracle/floating_point.h"
#include "reference/oracle/rational_geometry.h"
#include "tests/reference/oracle/meshes.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

using Corners3 = oracle::TriangleCorners;
using Polygon = std::vector<oracle::rational::Point>;

mpq_class dot(const oracle::rational::Point& a, const oracle::rational::Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

oracle::rational::Point minus(const oracle::rational::Point& a, const oracle::rational::Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

oracle::rational::Point cross(const oracle::rational::Point& a, const oracle::rational::Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// What a convex polygon (or segment, or point) has on the side of `through` to which the normal
// points, by Sutherland and Hodgman.
Polygon clipped(const Polygon& polygon, const oracle::rational::Point& normal,
                const oracle::rational::Point& through) {
  Polygon out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const oracle::rational::Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const mpq_class at_p = dot(normal, minus(p, through)), at_q = dot(normal, minus(q, through));
    if (at_p >= 0) out.push_back(p);
    if (sgn(at_p) * sgn(at_q) >= 0) continue;
    const mpq_class s = at_p / (at_p - at_q);
    oracle::rational::Point x;
    for (std::size_t axis = 0; axis < 3; ++axis) x[axis] = p[axis] + s * (q[axis] - p[axis]);
    out.push_back(x);
  }
  return out;
}

// The diameter, by clipping all of p as a polygon. @pre q is proper
double rational_length(const Corners3& p, const Corners3& q) {
  Polygon left{oracle::rational::to_rational(p[0]), oracle::rational::to_rational(p[1]),
               oracle::rational::to_rational(p[2])};
  const Polygon t{oracle::rational::to_rational(q[0]), oracle::rational::to_rational(q[1]),
                  oracle::rational::to_rational(q[2])};
  const oracle::rational::Point n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  left = clipped(left, n, t[0]);
  left = clipped(left, minus(oracle::rational::Point{0, 0, 0}, n), t[0]);
  for (std::size_t k = 0; k < 3; ++k)
    left = clipped(left, cross(n, minus(t[(k + 1) % 3], t[k])), t[k]);
  mpq_class best = 0;
  for (const oracle::rational::Point& x : left)
    for (const oracle::rational::Point& y : left)
      best = std::max(best, dot(minus(x, y), minus(x, y)));
  return std::sqrt(best.get_d());
}

double size_of(const Corners3& p, const Corners3& q) {
  return std::max(oracle::largest_side(p), oracle::largest_side(q));
}

// Checks all three functions in both orders; returns the length.
double check_pair(const Corners3& p, const Corners3& q, bool& fast) {
  const double expected = rational_length(p, q), size = size_of(p, q);
  const std::string input = hex_points(p) + '\n' + hex_points(q);
  EXPECT_NEAR(oracle::intersection_length(p, q), expected, 1e-9 * size) << input;
  EXPECT_NEAR(oracle::intersection_length(q, p), expected, 1e-9 * size) << input;
  EXPECT_NEAR(oracle::exact_intersection_length(p, q), expected, 1e-14 * size) << input;
  const std::optional<double> crossing = oracle::crossing_length(p, q);
  fast = crossing.has_value();
  if (fast) {
    EXPECT_NEAR(*crossing, expected, 1e-9 * size) << input;
  }
  return expected;
}

const Corners3 kGround{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

double with_floor(const Corners3& q) {
  const double length = oracle::intersection_length(kGround, q);
  EXPECT_NEAR(oracle::intersection_length(q, kGround), length, 4e-9);
  return length;
}

TEST(IntersectionLength, CrossingTrianglesShareASegment) {
  // Its piece of the floor runs from (1, 1) to (1, 2).
  EXPECT_DOUBLE_EQ(with_floor({Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(1, 3, 1)}), 1.0);
  EXPECT_DOUBLE_EQ(with_floor({Vec3(1, -9, -9), Vec3(1, 30, -9), Vec3(1, 1, 20)}), 3.0);
  EXPECT_EQ(with_floor({Vec3(5, 1, -1), Vec3(5, 1, 1), Vec3(5, 3, 1)}), 0.0);  // its plane crosses
  EXPECT_EQ(with_floor({Vec3(1, 1, 1), Vec3(1, 1, 2), Vec3(1, 3, 1)}), 0.0);   // above
}

TEST(IntersectionLength, TouchingAtAPointIsZero) {
  EXPECT_EQ(with_floor({Vec3(1, 1, 0), Vec3(1, 1, 1), Vec3(1, 3, 1)}), 0.0);     // corner on face
  EXPECT_EQ(with_floor({Vec3(4, 0, 0), Vec3(5, 1, 1), Vec3(5, 3, 1)}), 0.0);     // at a corner
  EXPECT_EQ(with_floor({Vec3(2, -1, -1), Vec3(2, 1, 1), Vec3(2, -9, 9)}), 0.0);  // edge on edge
  EXPECT_EQ(with_floor({Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 0)}), 0.0);   // in its plane
}

TEST(IntersectionLength, TouchingAlongASegment) {
  EXPECT_DOUBLE_EQ(with_floor({Vec3(1, 1, 0), Vec3(2, 1, 0), Vec3(1, 1, 1)}), 1.0);  // edge on face
  EXPECT_DOUBLE_EQ(with_floor({Vec3(1, 0, 0), Vec3(9, 0, 0), Vec3(1, -1, 0)}), 3.0);  // on an edge
  EXPECT_DOUBLE_EQ(with_floor({Vec3(1, 0, 0), Vec3(3, 0, 0), Vec3(1, 0, 1)}), 2.0);
}

TEST(IntersectionLength, CoplanarTrianglesGiveTheDiameter) {
  EXPECT_DOUBLE_EQ(with_floor(kGround), std::sqrt(32.0));
  // The inner triangle's hypotenuse.
  EXPECT_DOUBLE_EQ(with_floor({Vec3(0.5, 0.5, 0), Vec3(1.5, 0.5, 0), Vec3(0.5, 1.5, 0)}),
                   std::sqrt(2.0));
  // A star of six points: the hexagon's longest diagonal.
  const Corners3 up{Vec3(0, 0, 0), Vec3(6, 0, 0), Vec3(0, 6, 0)};
  const Corners3 down{Vec3(4, 4, 0), Vec3(-2, 4, 0), Vec3(4, -2, 0)};
  EXPECT_DOUBLE_EQ(oracle::intersection_length(up, down), std::sqrt(32.0));
}

TEST(IntersectionLength, SegmentsAndPoints) {
  const auto segment = [](const Vec3& a, const Vec3& b) { return Corners3{a, b, 0.5 * (a + b)}; };
  EXPECT_DOUBLE_EQ(with_floor(segment(Vec3(1, 1, 0), Vec3(9, 1, 0))), 2.0);
  EXPECT_EQ(with_floor(segment(Vec3(1, 1, -1), Vec3(1, 1, 1))), 0.0);
  EXPECT_EQ(with_floor(segment(Vec3(5, 1, 0), Vec3(9, 1, 0))), 0.0);
  EXPECT_EQ(with_floor({Vec3(1, 1, 0), Vec3(1, 1, 0), Vec3(1, 1, 0)}), 0.0);
  const auto both = oracle::intersection_length;
  const Corners3 s = segment(Vec3(0, 0, 0), Vec3(2, 4, 6));
  EXPECT_DOUBLE_EQ(both(s, segment(Vec3(1, 2, 3), Vec3(9, 18, 27))), std::sqrt(14.0));
  EXPECT_EQ(both(s, segment(Vec3(2, 4, 6), Vec3(9, 18, 27))), 0.0);
  EXPECT_EQ(both(s, segment(Vec3(0, 4, 3), Vec3(2, 0, 3))), 0.0);  // cross in one point
  EXPECT_EQ(both(s, {Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3)}), 0.0);
}

TEST(IntersectionLengthAgainstRational, RandomPairsAreMostlyFast) {
  TriangleSource source(901);
  int hits = 0, fast_hits = 0, fast_count = 0;
  for (int i = 0; i < 500; ++i) {
    const Corners3 p = source.triangle(Vec3::Zero(), 1), q = source.triangle(Vec3::Zero(), 1);
    bool fast = false;
    const bool hit = check_pair(p, q, fast) > 0;
    hits += hit;
    fast_hits += hit && fast;
    fast_count += fast;
  }
  EXPECT_GT(hits, 80);
  EXPECT_GT(fast_hits, hits * 98 / 100);
  EXPECT_GT(fast_count, 490);
}

TEST(IntersectionLengthAgainstRational, GridPairsCoplanarAndTouchingAmongThem) {
  TriangleSource source(902);
  int hits = 0, fast_count = 0, pairs = 0;
  while (pairs < 700) {
    Corners3 p = source.grid_triangle(2), q = source.grid_triangle(2);
    if (source.below(3) == 0)
      for (int k = 0; k < 3; ++k) p[k].z() = q[k].z() = 1;
    if (oracle::collinear(q[0], q[1], q[2])) continue;
    bool fast = false;
    ++pairs;
    hits += check_pair(p, q, fast) > 0;
    fast_count += fast;
  }
  EXPECT_GT(hits, 200);
  EXPECT_LT(hits, 600);
  EXPECT_GT(fast_count, 100);
  EXPECT_LT(fast_count, 650);
}

// Planes that meet at angles from 2^-5 down to 2^-40, corners that nearly touch, and slivers.
TEST(IntersectionLengthAgainstRational, NearlyDegeneratePairs) {
  TriangleSource source(903);
  int hits = 0, fast_hits = 0;
  for (int i = 0; i < 500; ++i) {
    const double tilt = std::ldexp(1.0, -5 - source.below(36));
    const Corners3 p = source.triangle(Vec3::Zero(), 1);
    Corners3 q = source.near_degenerate_partner(p, 1);
    if (i % 2)
      for (int k = 0; k < 3; ++k) {
        const double s = source.unit(), r = source.unit();
        q[k] = source.point(p[0] + s * (p[1] - p[0]) + r * (p[2] - p[0]), tilt);
      }
    if (oracle::collinear(q[0], q[1], q[2])) continue;
    bool fast = false;
    const bool hit = check_pair(p, q, fast) > 0;
    hits += hit;
    fast_hits += hit && fast;
  }
  EXPECT_GT(hits, 130);
  EXPECT_GT(fast_hits, 15);
  EXPECT_LT(fast_hits, hits - 50);
}

Corners3 transformed(const Corners3& t, double scale, const Vec3& offset) {
  return {t[0] * scale + offset, t[1] * scale + offset, t[2] * scale + offset};
}

TEST(IntersectionLength, IntegerTranslationChangesNothing) {
  TriangleSource source(904);
  for (int i = 0; i < 300; ++i) {
    const Corners3 p = source.grid_triangle(9), q = source.grid_triangle(9);
    const Vec3 offset = source.grid_point(1) * 0x1p+48;
    EXPECT_EQ(oracle::intersection_length(transformed(p, 1, offset), transformed(q, 1, offset)),
              oracle::intersection_length(p, q))
        << hex_points(p) << '\n'
        << hex_points(q);
  }
}

TEST(IntersectionLength, ScalingByPowersOfTwoScalesIt) {
  TriangleSource source(905);
  for (int i = 0; i < 100; ++i) {
    const Corners3 p = source.grid_triangle(5), q = source.grid_triangle(5);
    const double length = oracle::intersection_length(p, q);
    for (int k : {-1000, -600, -60, 60, 600, 1000}) {
      const double scale = std::ldexp(1.0, k);
      EXPECT_NEAR(oracle::intersection_length(transformed(p, scale, Vec3::Zero()),
                                              transformed(q, scale, Vec3::Zero())) /
                      scale,
                  length, 1e-9 * size_of(p, q))
          << k << '\n'
          << hex_points(p) << '\n'
          << hex_points(q);
    }
  }
}

TEST(IntersectionLength, SubnormalAndHugeCoordinates) {
  const Corners3 wall{Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(1, 3, 1)};
  for (double scale : {0x1p-1074, 0x1p+1021})
    EXPECT_EQ(oracle::intersection_length(transformed(kGround, scale, Vec3::Zero()),
                                          transformed(wall, scale, Vec3::Zero())),
              scale);
  // Tiny triangles beside a coordinate of ordinary size.
  const auto raised = [](Corners3 t) {
    for (Vec3& c : t) c = Vec3(1, c.x() * 1e-200, c.y() * 1e-200);
    return t;
  };
  EXPECT_NEAR(oracle::intersection_length(raised(kGround), raised(kGround)),
              std::sqrt(32.0) * 1e-200, 1e-213);
}

TEST(IntersectionLength, FourPartsOfATriangleAddUp) {
  TriangleSource source(906);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const Corners3 p = source.triangle(Vec3::Zero(), 1), q = source.triangle(Vec3::Zero(), 1);
    const Vec3 ab = 0.5 * (p[0] + p[1]), bc = 0.5 * (p[1] + p[2]), ca = 0.5 * (p[2] + p[0]);
    double sum = 0;
    for (const Corners3& part : {Corners3{p[0], ab, ca}, Corners3{ab, p[1], bc},
                                 Corners3{ca, bc, p[2]}, Corners3{ab, bc, ca}})
      sum += oracle::intersection_length(part, q);
    const double whole = oracle::intersection_length(p, q);
    EXPECT_NEAR(sum, whole, 1e-9) << hex_points(p) << '\n' << hex_points(q);
    hits += whole > 0;
  }
  EXPECT_GT(hits, 50);
}

}  // namespace
}  // namespace contactcheck::test
