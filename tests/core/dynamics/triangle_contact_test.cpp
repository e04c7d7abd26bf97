#include "core/dynamics/triangle_contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_triangles.h"

namespace contactcheck {
namespace {

const TrianglePoints kFloor = {Vec3(-1, -1, 0), Vec3(3, -1, 0), Vec3(-1, 3, 0)};  // faces +z

Vec3 at(const Barycentric& w, const TrianglePoints& t) {
  return w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
}

double longest_edge(const TrianglePoints& t) {
  return std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
}

void expect_convex_weights(const Barycentric& w) {
  for (double weight : w) EXPECT_GE(weight, 0.0);
  EXPECT_NEAR(w[0] + w[1] + w[2], 1.0, 1e-15);
}

TEST(TriangleContact, OfAKnownCrossing) {
  const TrianglePoints wedge = {Vec3(0, 0, -0.25), Vec3(0, 1, 0.75), Vec3(0, -1, 0.75)};
  const TriangleContact c = triangle_contact(kFloor, wedge);
  EXPECT_LE((c.normal - Vec3(-1, 0, 1) / std::sqrt(2.0)).norm(), 1e-15);
  EXPECT_NEAR(c.depth, 0.25, 1e-15);  // the wedge is nearer to its way out than the floor, by 3/4
  EXPECT_LE(at(c.on_a, kFloor).norm(), 1e-15);  // they cross from y = -1/4 to 1/4
  EXPECT_LE(at(c.on_b, wedge).norm(), 1e-15);
}

TEST(TriangleContact, OfOpposedFacesIsTheirOverlap) {
  const TrianglePoints ceiling = {Vec3(-1, -1, -0.125), Vec3(-1, 3, -0.125), Vec3(3, -1, -0.125)};
  const TriangleContact c = triangle_contact(kFloor, ceiling);
  EXPECT_EQ(c.normal, Vec3::UnitZ());
  EXPECT_EQ(c.depth, 0.125);
}

TEST(TriangleContact, IsNotDeeperThanItsTrianglesAreLarge) {
  const TrianglePoints deep = {Vec3(0, 0, -90), Vec3(0, 0.5, -90), Vec3(0.5, 0, -90)};
  EXPECT_EQ(triangle_contact(kFloor, deep).depth, std::sqrt(0.5));
  const TrianglePoints above = {Vec3(0, 0, 1), Vec3(0, 0.5, 1), Vec3(0.5, 0, 1)};
  EXPECT_EQ(triangle_contact(kFloor, above).depth, 0.0);
}

TEST(TriangleContact, OfFlushFacesPointsToTheOther) {
  TrianglePoints beside = kFloor;
  for (Vec3& p : beside) p += Vec3(1, 0, 0);
  const TriangleContact c = triangle_contact(kFloor, beside);
  EXPECT_LE((c.normal - Vec3::UnitX()).norm(), 1e-15);
  EXPECT_EQ(c.depth, 0.0);
}

TEST(TriangleContact, WithADegenerateTriangleUsesTheOthersPlane) {
  const TrianglePoints needle = {Vec3(0, 0, -0.25), Vec3(0, 0, 0.5), Vec3(0, 0, 1)};
  const TriangleContact c = triangle_contact(kFloor, needle);
  EXPECT_EQ(c.normal, Vec3::UnitZ());
  EXPECT_EQ(c.depth, 0.25);
  EXPECT_EQ(triangle_contact(needle, kFloor).normal, Vec3(-Vec3::UnitZ()));
  EXPECT_EQ(triangle_contact(needle, kFloor).depth, 0.25);
}

TEST(TriangleContact, OfDegenerateTrianglesIsFinite) {
  test::TriangleSource random(73);
  std::size_t without_direction = 0, degenerate = 0;
  for (int round = 0; round < 20'000; ++round) {
    const TrianglePoints a = random.grid_triangle(1), b = random.grid_triangle(1);
    const TriangleContact c = triangle_contact(a, b);
    expect_convex_weights(c.on_a);
    expect_convex_weights(c.on_b);
    EXPECT_GE(c.depth, 0.0);
    EXPECT_LE(c.depth, std::min(longest_edge(a), longest_edge(b)));
    if (c.normal.isZero(0.0)) {
      EXPECT_LE((a[0] + a[1] + a[2] - b[0] - b[1] - b[2]).norm(), 1e-15);
      ++without_direction;
    } else {
      EXPECT_NEAR(c.normal.norm(), 1.0, 1e-15);
    }
    if ((a[1] - a[0]).cross(a[2] - a[0]).isZero(0.0)) ++degenerate;
  }
  EXPECT_GT(degenerate, 1000u);
  EXPECT_GT(without_direction, 3u);
}

TEST(TriangleContact, OfCrossingTrianglesIsOnePointOfBothAndTurnsWithThem) {
  test::TriangleSource random(74);
  std::size_t crossing = 0;
  for (int round = 0; round < 5000; ++round) {
    const TrianglePoints a = random.triangle(Vec3::Zero(), 1.0);
    const TrianglePoints b = random.triangle(Vec3::Zero(), 1.0);
    if (!triangles_intersect(a, b)) continue;
    const TriangleContact c = triangle_contact(a, b), turned = triangle_contact(b, a);
    EXPECT_EQ(turned.normal, Vec3(-c.normal));
    EXPECT_EQ(turned.depth, c.depth);
    // Measured: 1e-15. Nearly parallel planes and thin triangles may lose a few digits more.
    EXPECT_LE((at(c.on_a, a) - at(c.on_b, b)).norm(), 1e-11);
    EXPECT_LE((at(turned.on_b, a) - at(c.on_a, a)).norm(), 1e-11);
    ++crossing;
  }
  EXPECT_GT(crossing, 500u);
}

TEST(NearestOnTriangle, IsNoFartherThanAnySample) {
  test::TriangleSource random(75);
  constexpr int kSteps = 12;
  for (int round = 0; round < 1000; ++round) {
    const TrianglePoints t = round % 2 ? random.grid_triangle(2) : random.triangle({1, 2, 3}, 1.0);
    const Vec3 point = random.point(t[0], 2.0);
    const Barycentric w = nearest_on_triangle(point, t);
    expect_convex_weights(w);
    const double distance = (at(w, t) - point).norm();
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j) {
        const double u = static_cast<double>(i) / kSteps, v = static_cast<double>(j) / kSteps;
        EXPECT_LE(distance, (at({1.0 - u - v, u, v}, t) - point).norm() + 1e-12);
      }
  }
}

}  // namespace
}  // namespace contactcheck
