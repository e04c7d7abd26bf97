#include "core/broad/sphere.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_triangles.h"
#include "tests/support/wide.h"

namespace contactcheck {
namespace {

using test::Wide;

Wide squared_distance(const Vec3& a, const Vec3& b) {
  Wide sum = 0;
  for (int k = 0; k < 3; ++k) sum += (Wide(a[k]) - Wide(b[k])) * (Wide(a[k]) - Wide(b[k]));
  return sum;
}

bool overlap_exactly(const Sphere& a, const Sphere& b) {
  const Wide reach = Wide(a.radius) + Wide(b.radius);
  return squared_distance(a.center, b.center) <= reach * reach;
}

TEST(Sphere, TouchingIsContactForSafeAndNoneForStrict) {
  const Sphere a{Vec3(1, 2, 3), 0.75}, touching{Vec3(1, 4, 3), 1.25};
  EXPECT_TRUE(collide_safe(a, touching));
  EXPECT_FALSE(collide_strict(a, touching));

  const Sphere closer{Vec3(1, std::nextafter(4.0, 0.0), 3), 1.25};
  EXPECT_TRUE(collide_safe(a, closer));
  EXPECT_TRUE(collide_strict(a, closer));

  // One ulp apart: strict sees none; safe rounds outward and may say yes, but not at 1e-14.
  const Sphere farther{Vec3(1, std::nextafter(4.0, 9.0), 3), 1.25};
  EXPECT_FALSE(collide_strict(a, farther));
  EXPECT_FALSE(collide_safe(a, {Vec3(1, 4 + 4e-14, 3), 1.25}));
}

TEST(Sphere, PointsAtOnePlace) {
  const Sphere a{Vec3(0.1, 0.2, 0.3), 0.0};
  EXPECT_TRUE(collide_safe(a, a));
  EXPECT_FALSE(collide_strict(a, a));
}

TEST(Sphere, SafeIsTrueWheneverTheBallsMeetAndTight) {
  test::TriangleSource random(61);
  int overlapping = 0, found = 0;
  constexpr int kRounds = 20000;
  for (int round = 0; round < kRounds; ++round) {
    const double offset = random.below(2) ? 0.0 : 1e6;
    Sphere a{random.point(Vec3::Constant(offset), 1.0), std::abs(random.unit())};
    Sphere b{random.point(Vec3::Constant(offset), 1.0), 0.0};
    // Radii that sum to the distance, up to a few ulps.
    b.radius = std::max(0.0, (a.center - b.center).norm() - a.radius);
    for (int step = random.below(9) - 4; step != 0; step += step < 0 ? 1 : -1)
      b.radius = std::nextafter(b.radius, step > 0 ? 9.0 : 0.0);
    overlapping += overlap_exactly(a, b);
    found += collide_safe(a, b);
    EXPECT_TRUE(collide_safe(a, b) || !overlap_exactly(a, b)) << round;
    if (a.radius + b.radius > 0.01) {
      Sphere smaller = b;
      smaller.radius -= 1e-13;
      EXPECT_FALSE(smaller.radius > 0 && (a.center - b.center).norm() > a.radius &&
                   collide_safe(a, smaller))
          << round;
    }
  }
  EXPECT_GT(overlapping, kRounds / 4);
  EXPECT_LT(overlapping, kRounds * 9 / 10);
  EXPECT_GE(found, overlapping);
}

TEST(Sphere, SafeHoldsWhereSquaresUnderflow) {
  for (double scale : {1e-150, 1e-170, 1e-300, 0x1p-1074}) {
    const Sphere a{Vec3::Zero(), scale}, b{Vec3(2 * scale, 0, 0), scale};
    EXPECT_TRUE(collide_safe(a, b)) << scale;
  }
}

TEST(Sphere, SafeHoldsWhereSquaresOverflow) {
  for (double scale : {1e154, 1e200, 1e300}) {
    const Sphere a{Vec3::Zero(), scale}, b{Vec3(1.5 * scale, 0, 0), scale};
    EXPECT_TRUE(collide_safe(a, b)) << scale;
  }
}

TEST(CoveringRadius, HoldsEveryPointMovedBySlack) {
  test::TriangleSource random(62);
  for (int round = 0; round < 5000; ++round) {
    const double offset = round % 3 == 0 ? 1e6 : 0.0;
    const Vec3 center = random.point(Vec3::Constant(offset), 1.0);
    std::vector<Vec3> points;
    for (int i = 0; i < 8; ++i) points.push_back(random.point(Vec3::Constant(offset), 1.0));
    const double radius = covering_radius(center, points, 0.0);
    double largest = 0.0;
    for (const Vec3& p : points) {
      EXPECT_LE(squared_distance(p, center), Wide(radius) * Wide(radius));
      largest = std::max(largest, (p - center).norm());
    }
    EXPECT_LE(radius, largest * (1 + 1e-14));
    EXPECT_GE(covering_radius(center, points, 0.25), radius + 0.25);
  }
}

TEST(CoveringRadius, HoldsPointsWhoseSquaresUnderflow) {
  for (double scale : {1e-160, 1e-200, 0x1p-1074}) {
    const std::vector<Vec3> points = {Vec3(scale, scale, -scale)};
    EXPECT_GE(covering_radius(Vec3::Zero(), points, 0.0), 2 * scale) << scale;
  }
}

TEST(CoveringRadius, OfNothingIsItsSlack) {
  EXPECT_NEAR(covering_radius(Vec3(1, 2, 3), {}, 0.5), 0.5, 1e-14);
}

}  // namespace
}  // namespace contactcheck
