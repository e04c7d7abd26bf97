// Every certificate is checked here by other rational arithmetic than made it, and the verdict by
// linear programming.
#include "reference/oracle/pair_certificate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reference/oracle/rational_geometry.h"
#include "tests/hard/corpus.h"
#include "tests/support/random_triangles.h"
#include "tests/support/range_ends.h"

namespace contactcheck::oracle::certify {
namespace {

using RationalPoint = oracle::rational::Point;
using oracle::rational::TriangleCorners;

constexpr int kHex = 16;

RationalPoint weighted(const TriangleCorners& t, const std::array<std::string, 3>& weights) {
  mpq_class sum = 0;
  RationalPoint out;
  for (std::size_t k = 0; k < 3; ++k) {
    const mpq_class weight(weights[k], kHex);
    EXPECT_GE(weight, 0);
    sum += weight;
    const RationalPoint corner = oracle::rational::to_rational(t[k]);
    for (std::size_t axis = 0; axis < 3; ++axis) out[axis] += weight * corner[axis];
  }
  EXPECT_GT(sum, 0);
  for (mpq_class& x : out) x /= sum;
  return out;
}

mpq_class value_of(const ExactNumber& number) {
  if (const auto* value = std::get_if<double>(&number)) return mpq_class(*value);
  return mpq_class(std::get<std::string>(number), kHex);
}

mpq_class height(const Plane& plane, const Vec3& corner) {
  mpq_class out = -value_of(plane.offset);
  for (int axis = 0; axis < 3; ++axis)
    out += value_of(plane.normal[static_cast<std::size_t>(axis)]) * mpq_class(corner[axis]);
  return out;
}

bool in_doubles(const Plane& plane) {
  return std::all_of(plane.normal.begin(), plane.normal.end(),
                     [](const ExactNumber& n) { return std::holds_alternative<double>(n); });
}

/// What came out of many pairs.
struct Tally {
  int meet = 0, parted_by_doubles = 0, parted_by_rationals = 0;

  void check(const TriangleCorners& p, const TriangleCorners& q) {
    const auto witness = common_point(p, q);
    const auto plane = separating_plane(p, q);
    const bool expected = oracle::rational::triangles_intersect(p, q);
    ASSERT_EQ(witness.has_value(), expected);
    ASSERT_EQ(plane.has_value(), !expected);
    if (witness) {
      ++meet;
      EXPECT_EQ(weighted(p, witness->p), weighted(q, witness->q));
    } else {
      ++(in_doubles(*plane) ? parted_by_doubles : parted_by_rationals);
      for (const Vec3& corner : p) EXPECT_LE(height(*plane, corner), 0);
      for (const Vec3& corner : q) EXPECT_GT(height(*plane, corner), 0);
    }
  }
};

TEST(Certificate, OfGenericPairs) {
  test::TriangleSource random(1);
  Tally tally;
  for (int i = 0; i < 1000; ++i)
    tally.check(random.triangle(Vec3::Zero(), 1), random.triangle(Vec3::Zero(), 1));
  EXPECT_GT(tally.meet, 50);
  EXPECT_GT(tally.parted_by_doubles, 500);
}

// Segments and points of small integers, of which many lie in one plane or on one line.
TriangleCorners flattened(test::TriangleSource& random) {
  TriangleCorners t = random.grid_triangle(1 + random.below(3));
  const int kind = random.below(4);
  if (kind > 0) t[2] = t[static_cast<std::size_t>(random.below(2))];
  if (kind > 2) t[0] = t[1] = t[2];
  return t;
}

TEST(Certificate, NearestPointsAreOfTheTrianglesAndAsFarApartAsThey) {
  test::TriangleSource source(703);
  for (int i = 0; i < 300; ++i) {
    const TriangleCorners p = i % 2 ? source.grid_triangle(2) : source.triangle(Vec3::Zero(), 1),
                          q = i % 2 ? source.grid_triangle(2) : source.triangle(Vec3(1, 0, 0), 1);
    const auto [on_p, on_q] = nearest_points_rounded(p, q);
    const double distance = std::sqrt(oracle::rational::squared_distance(p, q).get_d());
    EXPECT_NEAR((on_p - on_q).norm(), distance, 1e-14);
    EXPECT_LE(oracle::rational::squared_distance({on_p, on_p, on_p}, p), 1e-30);
    EXPECT_LE(oracle::rational::squared_distance({on_q, on_q, on_q}, q), 1e-30);
  }
}

TEST(Certificate, OfDegeneratePairs) {
  test::TriangleSource random(2);
  Tally tally;
  for (int i = 0; i < 4000; ++i) tally.check(flattened(random), flattened(random));
  EXPECT_GT(tally.meet, 200);
  EXPECT_GT(tally.parted_by_doubles, 500);
  EXPECT_GT(tally.parted_by_rationals, 100);
}

TEST(Certificate, OfPairsThatTouchOrAreAnUlpApart) {
  test::TriangleSource random(3);
  Tally tally;
  for (int i = 0; i < 3000; ++i) {
    const TrianglePoints p = random.triangle(Vec3(3, -2, 1), 1);
    tally.check(p, random.near_degenerate_partner(p, 1));
  }
  EXPECT_GT(tally.meet, 500);
  EXPECT_GT(tally.parted_by_doubles, 300);
  EXPECT_GT(tally.parted_by_rationals, 5);
}

TEST(Certificate, AtTheEndsOfTheRangeOfDoubles) {
  Tally tally;
  for (test::RangeEnd end :
       {test::RangeEnd::kLargest, test::RangeEnd::kDenormal, test::RangeEnd::kBoth}) {
    test::RangeEndSource random(4, end);
    for (int i = 0; i < 60; ++i)
      for (const test::TrianglePair& pair :
           {random.free_pair(), random.sharing_pair(), random.flat_pair(), random.lattice_pair()})
        tally.check(pair.first, pair.second);
  }
  EXPECT_GT(tally.meet, 100);
  EXPECT_GT(tally.parted_by_doubles, 100);
  EXPECT_GT(tally.parted_by_rationals, 20);
}

TEST(Certificate, OfAGapOfTheSmallestDouble) {
  const double least = test::kSmallestDouble;
  const TriangleCorners p = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  Tally tally;
  tally.check(p, {Vec3(1, 1, least), Vec3(9, 1, 5), Vec3(1, 9, 5)});
  tally.check(p, {Vec3(1, 1, least), Vec3(1, 1, least), Vec3(1, 1, least)});
  tally.check(p, {Vec3(-least, -1, 0), Vec3(-least, 9, 0), Vec3(-4, 1, 0)});
  tally.check({p[0], p[1], p[1]}, {Vec3(2, least, 0), Vec3(2, 3, 0), Vec3(2, 1, 0)});
  EXPECT_EQ(tally.meet, 0);
}

// Segments on one line and points have no direction among those that doubles try.
TEST(Certificate, OfSegmentsOnOneLineAndOfPoints) {
  const Vec3 u(1, 2, 3);
  const Vec3 zero = Vec3::Zero();
  Tally tally;
  tally.check({zero, u, zero}, {2 * u, 5 * u, 3 * u});
  tally.check({zero, zero, zero}, {u, u, u});
  EXPECT_EQ(tally.parted_by_rationals, 2);
  tally.check({zero, u, zero}, {u, 5 * u, 3 * u});
  tally.check({u, u, u}, {u, u, u});
  EXPECT_EQ(tally.meet, 2);
}

TriangleCorners corners(const test::HardFamily& family, std::size_t value, std::size_t body,
                        std::size_t triangle) {
  const Triangle& t = family.scene.bodies[body].shape->mesh.triangles[triangle];
  const std::vector<Vec3>& v = family.vertices[value][body];
  return {v[t[0]], v[t[1]], v[t[2]]};
}

TEST(Certificate, OfHardPairs) {
  Tally tally;
  for (const std::string& id : test::family_ids()) {
    SCOPED_TRACE(id);
    const test::HardFamily& family = test::hard_family(id);
    std::size_t triangles = 0;
    for (const Body& body : family.scene.bodies) triangles += body.shape->mesh.triangles.size();
    if (triangles > 2 || family.scene.bodies.size() != 2) continue;
    for (std::size_t v = 0; v < family.truth.size(); ++v)
      tally.check(corners(family, v, 0, 0), corners(family, v, 1, 0));
  }
  EXPECT_GT(tally.meet, 80);
  EXPECT_GT(tally.parted_by_doubles + tally.parted_by_rationals, 80);
}

}  // namespace
}  // namespace contactcheck::oracle::certify
