#include "reference/oracle/hull_overlap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/oracle/rational_geometry.h"
#include "tests/reference/oracle/meshes.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

Corners corners_of_box(const Vec3& lo, const Vec3& hi) {
  Corners out;
  for (int c = 0; c < 8; ++c)
    for (int k = 0; k < 3; ++k) out[c][k] = (c >> k) & 1 ? hi[k] : lo[k];
  return out;
}

Corners repeated(const Vec3& a, const Vec3& b) { return {a, b, a, b, a, b, a, b}; }

bool hulls_overlap(const Corners& a, const Corners& b) {
  return oracle::hulls_overlap(oracle::make_hull(a), oracle::make_hull(b));
}

// Eight weights each, all >= 0, summing to 1, with equal weighted points.
bool rational_overlap(const Corners& a, const Corners& b) {
  std::vector<oracle::rational::Equation> equations;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<mpq_class> row(16);
    for (std::size_t i = 0; i < 8; ++i) {
      row[i] = a[i][axis];
      row[8 + i] = -mpq_class(b[i][axis]);
    }
    equations.push_back({std::move(row), 0});
  }
  for (std::size_t side = 0; side < 2; ++side) {
    std::vector<mpq_class> row(16);
    for (std::size_t i = 0; i < 8; ++i) row[8 * side + i] = 1;
    equations.push_back({std::move(row), 1});
  }
  return oracle::rational::has_nonnegative_solution(std::move(equations));
}

bool check_pair(const Corners& a, const Corners& b) {
  const bool expected = rational_overlap(a, b);
  EXPECT_EQ(hulls_overlap(a, b), expected) << hex_points(a) << '\n' << hex_points(b);
  EXPECT_EQ(hulls_overlap(b, a), expected) << hex_points(b) << '\n' << hex_points(a);
  return expected;
}

template <typename MakeCorners>
void compare_hulls_with_rational(int count, int low, int high, MakeCorners&& make) {
  int hits = 0;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const Corners a = make();
    hits += check_pair(a, make());
  }
  EXPECT_GT(hits, low);
  EXPECT_LT(hits, high);
}

TEST(HullOverlap, BoxHasTwelveFacesWorthOfTriples) {
  const auto hull = oracle::make_hull(corners_of_box(Vec3(0, 0, 0), Vec3(1, 2, 3)));
  EXPECT_TRUE(hull.has_volume);
  EXPECT_EQ(hull.points.size(), 8u);
  EXPECT_EQ(hull.surface.size(), 24u);  // four triples of each quad
  for (const auto& face : hull.surface)
    EXPECT_LT(oracle::orientation(face[0], face[1], face[2], Vec3(0.5, 1, 1.5)), 0);
}

TEST(HullOverlap, InnerCornersAreNotOfTheSurface) {
  Corners c = corners_of_box(Vec3(0, 0, 0), Vec3(4, 4, 4));
  c[0] = Vec3(2, 2, 2.5);
  const auto hull = oracle::make_hull(c);
  for (const auto& face : hull.surface)
    for (const Vec3& p : face) EXPECT_NE(p, c[0]);
}

TEST(HullOverlap, CollinearCornersAreNoFace) {
  Corners c = corners_of_box(Vec3(0, 0, 0), Vec3(4, 4, 4));
  c[1] = Vec3(0, 0, 2);  // on the edge from corner 0 to corner 4
  for (const auto& face : oracle::make_hull(c).surface)
    EXPECT_FALSE(oracle::collinear(face[0], face[1], face[2]));
}

TEST(HullOverlap, BoxesApartTouchingNestedCrossing) {
  const Corners unit = corners_of_box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  const double next = std::nextafter(1.0, 2.0);
  EXPECT_TRUE(hulls_overlap(unit, unit));
  EXPECT_TRUE(hulls_overlap(unit, corners_of_box(Vec3(1, 0, 0), Vec3(2, 1, 1))));
  EXPECT_TRUE(hulls_overlap(unit, corners_of_box(Vec3(1, 1, 1), Vec3(2, 2, 2))));
  EXPECT_FALSE(hulls_overlap(unit, corners_of_box(Vec3(next, 0, 0), Vec3(2, 1, 1))));
  EXPECT_TRUE(hulls_overlap(unit, corners_of_box(Vec3(0.2, 0.2, 0.2), Vec3(0.8, 0.8, 0.8))));
  EXPECT_TRUE(hulls_overlap(corners_of_box(Vec3(0.2, 0.2, 0.2), Vec3(0.8, 0.8, 0.8)), unit));
  EXPECT_TRUE(hulls_overlap(unit, corners_of_box(Vec3(-1, 0.4, 0.4), Vec3(2, 0.6, 0.6))));
}

TEST(HullOverlap, EdgesThatCrossWithoutAHeldCorner) {
  // Two wedges, edge against crossed edge, `gap` apart: no face plane separates them.
  const auto wedge = [](double z, bool turned, double down) {
    Corners c;
    for (int i = 0; i < 8; ++i) {
      const double along = i & 1 ? 1 : -1, across = i & 2 ? 1 : -1;
      const bool edge = i < 4;
      const double off = edge ? 0 : across;
      c[i] = turned ? Vec3(off, along, 0) : Vec3(along, off, 0);
      c[i].z() = z + (edge ? 0 : down);
    }
    return c;
  };
  EXPECT_TRUE(hulls_overlap(wedge(0, false, -1), wedge(0, true, 1)));
  EXPECT_TRUE(hulls_overlap(wedge(0, false, -1), wedge(-0.5, true, 1)));
  EXPECT_FALSE(hulls_overlap(wedge(0, false, -1), wedge(0x1p-1074, true, 1)));
  EXPECT_FALSE(hulls_overlap(wedge(0, false, -1), wedge(0.25, true, 1)));
}

TEST(HullOverlap, FlatSegmentAndPointHulls) {
  const Corners unit = corners_of_box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  const Corners plate = corners_of_box(Vec3(-1, -1, 0.5), Vec3(2, 2, 0.5));
  EXPECT_FALSE(oracle::make_hull(plate).has_volume);
  EXPECT_TRUE(hulls_overlap(unit, plate));
  EXPECT_TRUE(hulls_overlap(plate, corners_of_box(Vec3(0, 0, 0.5), Vec3(1, 1, 0.5))));
  EXPECT_FALSE(hulls_overlap(plate, corners_of_box(Vec3(0, 0, 0.75), Vec3(1, 1, 0.75))));
  const Corners rod = repeated(Vec3(0.5, 0.5, 0.5), Vec3(0.6, 0.6, 0.6));
  EXPECT_TRUE(hulls_overlap(unit, rod));  // all inside
  EXPECT_TRUE(hulls_overlap(plate, rod));
  EXPECT_FALSE(hulls_overlap(plate, repeated(Vec3(0, 0, 1), Vec3(1, 1, 0.75))));
  const Corners point = repeated(Vec3(1, 1, 1), Vec3(1, 1, 1));
  EXPECT_TRUE(hulls_overlap(unit, point));
  EXPECT_TRUE(hulls_overlap(point, point));
  EXPECT_FALSE(hulls_overlap(point, rod));
  EXPECT_TRUE(hulls_overlap(point, repeated(Vec3(0, 0, 0), Vec3(2, 2, 2))));
}

TEST(HullOverlapAgainstRational, GridPointsFlatAndTouchingAmongThem) {
  TriangleSource source(401);
  compare_hulls_with_rational(700, 150, 650, [&] {
    const Vec3 shift = source.grid_point(2);
    const int limit = source.below(2);
    Corners c;
    for (Vec3& p : c) p = source.grid_point(1 + limit) + shift;
    if (source.below(4) == 0)
      for (Vec3& p : c) p.z() = p.x() - p.y();  // flat
    if (source.below(6) == 0)
      for (int i = 0; i < 8; ++i) c[i] = c[i % 2];  // a segment or a point
    return c;
  });
}

TEST(HullOverlapAgainstRational, GridBoxes) {
  TriangleSource source(402);
  compare_hulls_with_rational(300, 60, 280, [&] {
    const Aabb box = source.grid_box(3);
    return corners_of_box(box.lo, box.hi);
  });
}

// What really comes: boxes, rotated, with every corner displaced.
TEST(HullOverlapAgainstRational, DeformedBoxes) {
  TriangleSource source(403);
  compare_hulls_with_rational(400, 100, 320, [&] {
    const Corners c = corners_of_box(Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.4, 0.6));
    const auto rotation = random_rotation(source);
    const Vec3 offset = source.point(Vec3::Zero(), 0.9);
    Corners out;
    for (int i = 0; i < 8; ++i) out[i] = source.point(rotation * c[i] + offset, 0.1);
    return out;
  });
}

// Neighbours that share a face: corners bit-equal or one unit in the last place apart.
TEST(HullOverlapAgainstRational, SharedFacesOffByUlps) {
  TriangleSource source(404);
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    const auto rotation = random_rotation(source);
    Corners a = corners_of_box(Vec3(0, 0, 0), Vec3(1, 1, 1));
    Corners b = corners_of_box(Vec3(1, 0, 0), Vec3(2, 1, 1));
    for (int k = 0; k < 8; ++k) {
      a[k] = rotation * a[k];
      b[k] = rotation * b[k];
    }
    for (int k : {0, 2, 4, 6}) b[k] = source.jitter(b[k]);
    hits += check_pair(a, b);
    // All four shared corners one step away along the normal, or none.
    for (int k : {0, 2, 4, 6}) b[k] = a[k + 1] + 0x1p-52 * rotation.col(0) * source.below(3);
    hits += check_pair(a, b);
  }
  EXPECT_GT(hits, 60);
  EXPECT_LT(hits, 390);
}

TEST(HullOverlapAgainstRational, TinyScales) {
  for (double scale : {1e-160, 1e-300, 0x1p-1073}) {
    TriangleSource source(405);
    compare_hulls_with_rational(60, 10, 55, [&] {
      const Vec3 shift = source.grid_point(2);
      Corners c;
      for (Vec3& p : c) p = (source.grid_point(2) + shift) * scale;
      return c;
    });
  }
}

}  // namespace
}  // namespace contactcheck::test
