#include "reference/oracle/convex_penetration.h"

#include <gmock/gmock.h>

#include <cmath>

#include "reference/oracle/exact_tests.h"
#include "reference/oracle/hull_overlap.h"
#include "tests/reference/oracle/meshes.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

using Corners3 = oracle::TriangleCorners;

constexpr double kTolerance = 1e-9;

oracle::Penetration part(const Corners3& a, const Corners3& b) {
  return oracle::convex_penetration({&a, 1}, {&b, 1}, kTolerance);
}

oracle::Penetration part(const oracle::ConvexHull& a, const oracle::ConvexHull& b) {
  return oracle::convex_penetration(a.surface, b.surface, kTolerance);
}

bool overlap(const Corners3& a, const Corners3& b) { return oracle::triangles_intersect(a, b); }
bool overlap(const oracle::ConvexHull& a, const oracle::ConvexHull& b) {
  return oracle::hulls_overlap(a, b);
}

std::span<const Vec3> points_of(const Corners3& t) { return t; }
std::span<const Vec3> points_of(const oracle::ConvexHull& hull) { return hull.points; }

Corners3 shifted(const Corners3& t, const Vec3& by) { return {t[0] + by, t[1] + by, t[2] + by}; }

oracle::ConvexHull shifted(const oracle::ConvexHull& hull, const Vec3& by) {
  Corners corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = hull.points[std::min(i, hull.points.size() - 1)] + by;
  return oracle::make_hull(corners);
}

// How far b has to go along a unit direction until the two touch at most.
double extent_along(const Vec3& unit, std::span<const Vec3> a, std::span<const Vec3> b) {
  double a_end = -1e300, b_begin = 1e300;
  for (const Vec3& p : a) a_end = std::max(a_end, unit.dot(p));
  for (const Vec3& p : b) b_begin = std::min(b_begin, unit.dot(p));
  return a_end - b_begin;
}

// Unit directions all over the sphere, from the grid on a cube round it.
std::vector<Vec3> directions_everywhere(int per_side) {
  std::vector<Vec3> out;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = -per_side; i <= per_side; ++i)
      for (int j = -per_side; j <= per_side; ++j) {
        Vec3 d;
        d[axis] = per_side;
        d[(axis + 1) % 3] = i;
        d[(axis + 2) % 3] = j;
        out.push_back(d.normalized());
        out.push_back(-out.back());
      }
  return out;
}

// No direction does better, coarsely all over and finely round the best ones; every direction that
// is told parts at that depth, and not before. Exact tests say what is separated.
template <typename Piece>
void check_penetration(const Piece& a, const Piece& b, TriangleSource& source) {
  static const std::vector<Vec3> everywhere = directions_everywhere(12);
  const oracle::Penetration way = part(a, b);
  const std::string input = hex_points(points_of(a)) + '\n' + hex_points(points_of(b));
  ASSERT_FALSE(way.directions.empty()) << input;
  for (const Vec3& d : everywhere)
    EXPECT_GE(extent_along(d, points_of(a), points_of(b)), way.depth - 1e-12) << input;
  for (const Vec3& d : way.directions) {
    EXPECT_NEAR(d.norm(), 1.0, 1e-14);
    EXPECT_NEAR(extent_along(d, points_of(a), points_of(b)), way.depth, kTolerance + 1e-12);
    EXPECT_FALSE(overlap(a, shifted(b, d * (way.depth + 2 * kTolerance)))) << input;
    for (double step : {1e-2, 1e-4, 1e-6}) {
      const Vec3 near = (d + source.point(Vec3::Zero(), step)).normalized();
      EXPECT_GE(extent_along(near, points_of(a), points_of(b)), way.depth - 1e-12) << input;
    }
  }
  if (way.depth > 1e-9) {
    EXPECT_TRUE(overlap(a, shifted(b, way.directions[0] * (way.depth - 1e-11)))) << input;
  }
}

MATCHER_P(IsDirection, direction, "") { return (arg - Vec3(direction)).norm() < 1e-12; }

const Corners3 kFloor{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};

TEST(PartTriangles, CornerThroughAFaceGoesBackThroughIt) {
  const Corners3 spike{Vec3(0.25, 0.25, -0.0625), Vec3(0.25, 0.25, 0.75), Vec3(0.25, 0.5, 0.75)};
  const oracle::Penetration way = part(kFloor, spike);
  EXPECT_NEAR(way.depth, 0.0625, 1e-15);
  EXPECT_THAT(way.directions, testing::ElementsAre(IsDirection(Vec3(0, 0, 1))));
  const oracle::Penetration other = part(spike, kFloor);
  EXPECT_NEAR(other.depth, 0.0625, 1e-15);
  EXPECT_THAT(other.directions, testing::ElementsAre(IsDirection(Vec3(0, 0, -1))));
}

TEST(PartTriangles, EdgesThatHookPartAlongTheirCommonNormal) {
  // Two upright triangles, one edge lying 1/8 above the other and across it.
  const Corners3 a{Vec3(-0.5, 0, 0), Vec3(0.5, 0, 0), Vec3(0, 0, -0.875)};
  const Corners3 b{Vec3(0, -0.5, -0.125), Vec3(0, 0.5, -0.125), Vec3(0, 0, 0.75)};
  const oracle::Penetration way = part(a, b);
  EXPECT_NEAR(way.depth, 0.125, 1e-15);
  EXPECT_THAT(way.directions, testing::ElementsAre(IsDirection(Vec3(0, 0, 1))));
}

TEST(PartTriangles, EquallyShortWaysAreAllTold) {
  // A segment through the middle of a square's half: 1/4 up or down.
  const Corners3 needle{Vec3(0.25, 0.25, -0.125), Vec3(0.25, 0.25, 0.125), Vec3(0.25, 0.25, 0.125)};
  const oracle::Penetration way = part(kFloor, needle);
  EXPECT_NEAR(way.depth, 0.125, 1e-15);
  EXPECT_THAT(way.directions, testing::UnorderedElementsAre(IsDirection(Vec3(0, 0, 1)),
                                                            IsDirection(Vec3(0, 0, -1))));
}

TEST(PartTriangles, SegmentNearAnEdgeLeavesSideways) {
  const Corners3 needle{Vec3(0.5, 0.0625, -0.5), Vec3(0.5, 0.0625, 0.5), Vec3(0.5, 0.0625, 0)};
  const oracle::Penetration way = part(kFloor, needle);
  EXPECT_NEAR(way.depth, 0.0625, 1e-15);
  EXPECT_THAT(way.directions, testing::ElementsAre(IsDirection(Vec3(0, -1, 0))));
}

TEST(PartTriangles, CoplanarPiecesPartAtZeroAlongTheNormal) {
  const oracle::Penetration way = part(kFloor, kFloor);
  EXPECT_EQ(way.depth, 0.0);
  EXPECT_THAT(way.directions, testing::UnorderedElementsAre(IsDirection(Vec3(0, 0, 1)),
                                                            IsDirection(Vec3(0, 0, -1))));
  // Two segments that cross span the plane together.
  const Corners3 p{Vec3(0, 0, 0.5), Vec3(1, 1, 0.5), Vec3(0, 0, 0.5)};
  const Corners3 q{Vec3(0, 1, 0.5), Vec3(1, 0, 0.5), Vec3(0, 1, 0.5)};
  const oracle::Penetration crossing = part(p, q);
  EXPECT_EQ(crossing.depth, 0.0);
  EXPECT_THAT(crossing.directions, testing::UnorderedElementsAre(IsDirection(Vec3(0, 0, 1)),
                                                                 IsDirection(Vec3(0, 0, -1))));
  // A point in a triangle's plane.
  const Vec3 inside(0.25, 0.25, 0);
  EXPECT_EQ(part(kFloor, Corners3{inside, inside, inside}).depth, 0.0);
}

TEST(PartTriangles, CollinearSegmentsAndPointsPartAtZeroAcross) {
  const Vec3 along(0.5, 0.25, -0.25);
  const Corners3 p{Vec3::Zero(), along, 0.5 * along}, q{0.25 * along, 2 * along, along};
  const Corners3 point{along, along, along};
  for (const auto& [a, b] : {std::pair(p, q), std::pair(p, point), std::pair(point, p)}) {
    const oracle::Penetration way = part(a, b);
    EXPECT_NEAR(way.depth, 0.0, 1e-16);
    EXPECT_EQ(way.directions.size(), 4u);
    for (const Vec3& d : way.directions) EXPECT_NEAR(d.dot(along), 0.0, 1e-16);
  }
  EXPECT_EQ(part(point, point).depth, 0.0);
  EXPECT_EQ(part(point, point).directions.size(), 6u);
}

TEST(PartTriangles, NoSampledDirectionIsShorter) {
  TriangleSource source(1001);
  int overlapping = 0;
  while (overlapping < 120 && !testing::Test::HasFailure()) {
    const Corners3 p = source.triangle(Vec3::Zero(), 0.7), q = source.triangle(Vec3::Zero(), 0.7);
    if (!overlap(p, q)) continue;
    ++overlapping;
    check_penetration(p, q, source);
  }
}

// Segments, points, coplanar pairs, shared corners.
TEST(PartTriangles, NoSampledDirectionIsShorterOnAGrid) {
  TriangleSource source(1002);
  int overlapping = 0, flat = 0;
  while (overlapping < 150 && !testing::Test::HasFailure()) {
    Corners3 p = source.grid_triangle(2), q = source.grid_triangle(2);
    for (int k = 0; k < 3; ++k) {
      p[k] *= 0.25;
      q[k] *= 0.25;
    }
    if (!overlap(p, q)) continue;
    ++overlapping;
    flat += part(p, q).depth == 0.0;
    check_penetration(p, q, source);
  }
  EXPECT_GT(flat, 20);
  EXPECT_LT(flat, 145);
}

Corners box_corners(const Vec3& lo, const Vec3& hi) {
  Corners out;
  for (int c = 0; c < 8; ++c)
    for (int k = 0; k < 3; ++k) out[c][k] = (c >> k) & 1 ? hi[k] : lo[k];
  return out;
}

oracle::ConvexHull box(const Vec3& lo, const Vec3& hi) {
  return oracle::make_hull(box_corners(lo, hi));
}

TEST(PartHulls, AxisAlignedBoxesLeaveByTheLeastOverlap) {
  const auto unit = box(Vec3(0, 0, 0), Vec3(0.5, 0.5, 0.5));
  const oracle::Penetration way =
      part(unit, box(Vec3(0.375, 0.125, 0.25), Vec3(0.875, 0.625, 0.75)));
  EXPECT_NEAR(way.depth, 0.125, 1e-15);
  EXPECT_THAT(way.directions, testing::ElementsAre(IsDirection(Vec3(1, 0, 0))));
  const oracle::Penetration two =
      part(unit, box(Vec3(0.375, -0.375, 0.125), Vec3(0.875, 0.125, 0.625)));
  EXPECT_NEAR(two.depth, 0.125, 1e-15);
  EXPECT_THAT(two.directions, testing::UnorderedElementsAre(IsDirection(Vec3(1, 0, 0)),
                                                            IsDirection(Vec3(0, -1, 0))));
  EXPECT_NEAR(part(unit, unit).depth, 0.5, 1e-15);
  EXPECT_EQ(part(unit, unit).directions.size(), 6u);
}

TEST(PartHulls, TouchingBoxesPartAtZero) {
  const oracle::Penetration way = part(box(Vec3(0, 0, 0), Vec3(0.5, 0.5, 0.5)),
                                       box(Vec3(0.5, 0.125, 0.25), Vec3(0.875, 0.25, 0.75)));
  EXPECT_EQ(way.depth, 0.0);
  EXPECT_THAT(way.directions, testing::ElementsAre(IsDirection(Vec3(1, 0, 0))));
}

TEST(PartHulls, CubeOnItsEdgeLeavesAlongTheCommonNormalOfTheEdges) {
  // Wedge edges along x and y, the upper one 1/16 below the lower one.
  Corners low, high;
  for (int i = 0; i < 8; ++i) {
    const double along = i & 1 ? 0.5 : -0.5, across = i < 4 ? 0 : (i & 2 ? 0.5 : -0.5);
    const double down = i < 4 ? 0 : 0.375;
    low[i] = Vec3(along, across, -down);
    high[i] = Vec3(across, along, down - 0.0625);
  }
  const oracle::Penetration way = part(oracle::make_hull(low), oracle::make_hull(high));
  EXPECT_NEAR(way.depth, 0.0625, 1e-15);
  EXPECT_THAT(way.directions, testing::ElementsAre(IsDirection(Vec3(0, 0, 1))));
}

TEST(PartHulls, FlatSegmentAndPointHulls) {
  const auto unit = box(Vec3(0, 0, 0), Vec3(0.5, 0.5, 0.5));
  const auto plate = box(Vec3(0.125, 0.125, 0.375), Vec3(0.25, 0.75, 0.375));
  EXPECT_NEAR(part(unit, plate).depth, 0.125, 1e-15);
  EXPECT_EQ(part(plate, plate).depth, 0.0);
  const Vec3 p(0.25, 0.4375, 0.25);
  const auto point = box(p, p);
  const oracle::Penetration way = part(unit, point);
  EXPECT_NEAR(way.depth, 0.0625, 1e-15);
  EXPECT_THAT(way.directions, testing::ElementsAre(IsDirection(Vec3(0, 1, 0))));
  const auto rod = box(Vec3(0.25, 0.25, -0.5), Vec3(0.25, 0.25, 0.0625));
  EXPECT_NEAR(part(unit, rod).depth, 0.0625, 1e-15);
}

// Boxes as they come: rotated, every corner displaced, also by so little that edges stay nearly
// parallel.
TEST(PartHulls, NoSampledDirectionIsShorterForDeformedBoxes) {
  TriangleSource source(1003);
  const Corners c = box_corners(Vec3(-0.25, -0.25, -0.25), Vec3(0.25, 0.2, 0.3));
  for (double displaced : {0.0, 1e-15, 1e-8, 0.05}) {
    int overlapping = 0;
    while (overlapping < 10 && !testing::Test::HasFailure()) {
      const auto rotation = random_rotation(source), other = random_rotation(source);
      const Vec3 offset = source.point(Vec3::Zero(), 0.3);
      Corners a, b;
      for (int i = 0; i < 8; ++i) {
        a[i] = source.point(rotation * c[i], displaced);
        b[i] = source.point((overlapping % 2 ? rotation : other) * c[i], displaced) + offset;
      }
      const auto p = oracle::make_hull(a), q = oracle::make_hull(b);
      if (!overlap(p, q)) continue;
      ++overlapping;
      check_penetration(p, q, source);
    }
  }
}

// The same boxes as the difference of parallelepipeds, where only face normals matter.
TEST(PartHulls, RotatedBoxesOfOneOrientationPartAlongTheirAxes) {
  TriangleSource source(1004);
  for (int i = 0; i < 30; ++i) {
    const auto rotation = random_rotation(source);
    const Vec3 overlaps(0.03125 * (1 + source.below(7)), 0.25, 0.25);
    const Vec3 offset = Vec3(0.25, 0.25, 0.25) - Vec3(overlaps.x(), 0, 0);
    Corners a = box_corners(Vec3(0, 0, 0), Vec3(0.25, 0.5, 0.5)), b = a;
    for (int k = 0; k < 8; ++k) {
      a[k] = rotation * a[k];
      b[k] = rotation * (b[k] + offset);
    }
    const oracle::Penetration way = part(oracle::make_hull(a), oracle::make_hull(b));
    EXPECT_NEAR(way.depth, overlaps.x(), 1e-14);
    ASSERT_EQ(way.directions.size(), overlaps.x() < 0.25 ? 1u : 3u);
    if (way.directions.size() == 1) {
      EXPECT_LT((way.directions[0] - rotation.col(0)).norm(), 1e-14);
    }
  }
}

// Facets that belong to edges one part in 2^12 to 2^48 from parallel.
TEST(PartTriangles, NearlyParallelEdges) {
  TriangleSource source(1005);
  int overlapping = 0;
  for (int i = 0; i < 80 && !testing::Test::HasFailure(); ++i) {
    const double angle = std::ldexp(1.0, -12 - source.below(37));
    Corners3 p = source.triangle(Vec3::Zero(), 0.4), q;
    for (int k = 0; k < 3; ++k) q[k] = source.point(p[k], angle);
    if (!overlap(p, q)) continue;
    ++overlapping;
    check_penetration(p, q, source);
  }
  EXPECT_GT(overlapping, 20);
}

TEST(PartTriangles, ScalesByPowersOfTwo) {
  TriangleSource source(1006);
  for (int i = 0; i < 50; ++i) {
    const Corners3 p = source.triangle(Vec3::Zero(), 0.7), q = source.triangle(Vec3::Zero(), 0.7);
    if (!overlap(p, q)) continue;
    const oracle::Penetration way = part(p, q);
    for (double scale : {0x1p-500, 0x1p-900}) {
      const auto small = [&](const Corners3& t) {
        return Corners3{t[0] * scale, t[1] * scale, t[2] * scale};
      };
      const Corners3 a = small(p), b = small(q);
      const oracle::Penetration scaled_way =
          oracle::convex_penetration({&a, 1}, {&b, 1}, kTolerance * scale);
      EXPECT_EQ(scaled_way.depth, way.depth * scale);
      EXPECT_EQ(scaled_way.directions, way.directions);
    }
  }
}

}  // namespace
}  // namespace contactcheck::test
