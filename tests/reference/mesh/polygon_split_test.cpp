// Triangles out of polygons: that they fill the polygon once, turned as it is.
#include "reference/mesh/polygon_split.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace contactcheck::mesh {
namespace {

using Points = std::vector<Vec3>;
using Polygon = std::vector<std::uint32_t>;

Polygon counted(std::size_t count) {
  Polygon out(count);
  std::iota(out.begin(), out.end(), 0u);
  return out;
}

Vec3 twice_area(const Points& p, const Polygon& corners) {
  Vec3 out = Vec3::Zero();
  for (std::size_t k = 2; k < corners.size(); ++k)
    out += (p[corners[k - 1]] - p[corners[0]]).cross(p[corners[k]] - p[corners[0]]);
  return out;
}

// As many triangles as a polygon has, each turned as it is, their areas together the polygon's: so
// none overlap and none stand outside.
void expect_filled(const Points& points, const Polygon& corners) {
  const auto split = split_polygon(points, corners);
  ASSERT_TRUE(split);
  EXPECT_EQ(split->triangles.size(), corners.size() - 2);
  const Vec3 whole = twice_area(points, corners);
  double sum = 0.0;
  for (const Triangle& t : split->triangles) {
    const Vec3 area = twice_area(points, {t[0], t[1], t[2]});
    EXPECT_GE(area.dot(whole), -1e-12 * whole.squaredNorm());
    sum += area.norm();
  }
  EXPECT_NEAR(sum, whole.norm(), 1e-9 * whole.norm());
}

// In every turn of its corners, either way round, in tilted planes and far from the origin.
void expect_filled_everywhere(const Points& flat) {
  const Vec3 tilts[][2] = {{Vec3::UnitX(), Vec3::UnitY()},
                           {Vec3::UnitY(), Vec3::UnitZ()},
                           {Vec3::UnitZ(), Vec3::UnitX()},
                           {Vec3(1, 2, -0.5), Vec3(0, 0.25, 1)}};
  for (const auto& tilt : tilts) {
    Points points;
    for (const Vec3& p : flat)
      points.push_back(p.x() * tilt[0] + p.y() * tilt[1] + Vec3(64, -32, 8));
    Polygon corners = counted(flat.size());
    for (int way = 0; way < 2; ++way, std::reverse(corners.begin(), corners.end()))
      for (std::size_t turn = 0; turn < flat.size(); ++turn) {
        expect_filled(points, corners);
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      }
  }
}

const Points kL = {{2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 0}};

TEST(PolygonSplit, AFanThatFitsStaysTheFan) {
  Points pentagon = {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 2, 0}, {-1, 1, 0}};
  const auto split = split_polygon(pentagon, counted(5));
  ASSERT_TRUE(split);
  EXPECT_FALSE(split->concave);
  EXPECT_THAT(split->triangles,
              ::testing::ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}));
  // Of the L's six corners two see all others: from those, too, it stays.
  EXPECT_TRUE(split_polygon(kL, counted(6))->concave);
  const std::vector<std::uint32_t> from_a_seeing_one = {2, 3, 4, 5, 0, 1};
  EXPECT_FALSE(split_polygon(kL, from_a_seeing_one)->concave);
}

TEST(PolygonSplit, FillsConcaveOutlinesOnce) {
  expect_filled_everywhere(kL);
  // A comb, whose teeth have corners on one line.
  Points comb = {{7, -1, 0}, {7, 2, 0}};
  for (int x = 6; x > 0; --x) comb.push_back({1.0 * x, x % 2 == 0 ? 0.0 : 2.0, 0.0});
  comb.insert(comb.end(), {{0, 2, 0}, {0, -1, 0}});
  expect_filled_everywhere(comb);
  // Corners in the middle of straight edges, and one twice.
  expect_filled_everywhere({{2, 0, 0},
                            {2, 0.5, 0},
                            {2, 1, 0},
                            {1, 1, 0},
                            {1, 1.5, 0},
                            {1, 2, 0},
                            {1, 2, 0},
                            {0, 2, 0},
                            {0, 1, 0},
                            {0, 0, 0},
                            {1, 0, 0}});
}

TEST(PolygonSplit, FillsRandomOutlinesOnce) {
  std::mt19937_64 random(11);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int i = 0; i < 60; ++i) {
    const std::size_t count = 4 + random() % 20;
    Points star, strip;
    for (std::size_t k = 0; k < count; ++k) {
      const double angle = 2 * M_PI * static_cast<double>(k) / static_cast<double>(count);
      const double radius = 0.05 + unit();
      star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.0});
      strip.push_back({static_cast<double>(k), 3.0 * unit(), 0.0});
    }
    expect_filled_everywhere(star);
    // There and back between two rows, of which the upper is 0.1 higher everywhere.
    for (std::size_t k = count; k-- > 0;) strip.push_back(strip[k] + Vec3(0, 0.1, 0));
    expect_filled_everywhere(strip);
  }
}

TEST(PolygonSplit, FillsARingThroughItsBridge) {
  const Points points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0},
                         {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}};
  Polygon ring = {0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
  for (std::size_t turn = 0; turn < ring.size(); ++turn) {
    expect_filled(points, ring);
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
  }
}

TEST(PolygonSplit, DecidesByExactSigns) {
  // The third corner is one unit in the last place inside the line from the second to the fourth.
  const double less = std::nextafter(0.5, 0.0);
  const Points points = {{1, 0, 0}, {0.5, less, 0}, {0, 1, 0}, {0, 0, 0}};
  for (const Polygon& corners : {Polygon{0, 1, 2, 3}, Polygon{2, 3, 0, 1}}) {
    const auto split = split_polygon(points, corners);
    ASSERT_TRUE(split && split->concave);
    for (const Triangle& t : split->triangles)
      EXPECT_TRUE(std::count(t.begin(), t.end(), 1u) == 1 &&
                  std::count(t.begin(), t.end(), 3u) == 1);
  }
  const double big = 0x1p1023, small = 0x1p-1070;
  for (const double scale : {big, small}) {
    Points scaled;
    for (const Vec3& p : kL) scaled.push_back((p - Vec3(1, 1, 0)) * scale);
    EXPECT_EQ(split_polygon(scaled, counted(6))->triangles,
              split_polygon(kL, counted(6))->triangles);
  }
}

TEST(PolygonSplit, RefusesWhatCrossesItself) {
  EXPECT_FALSE(split_polygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, counted(4)));
  EXPECT_FALSE(split_polygon({{0, 0, 1}, {1, 0, 1}, {2, 1, 1}, {1, 0, 1}}, counted(4)));
  Points pentagram;
  for (int k = 0; k < 5; ++k)
    pentagram.push_back({std::cos(0.8 * M_PI * k), std::sin(0.8 * M_PI * k), 0.0});
  EXPECT_FALSE(split_polygon(pentagram, counted(5)));
  // Every triangle of its fan turns one way, once and a quarter round.
  const Points spiral = {{0, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {2, 1, 0}};
  EXPECT_FALSE(split_polygon(spiral, counted(6)));
  Points saw = {{5000, -1, 0}};
  for (int k = 5000; k >= 0; --k) saw.push_back({1.0 * k, k % 2 == 0 ? 0.0 : 1.0, 0.0});
  saw.push_back({0, -1, 0});
  EXPECT_FALSE(split_polygon(saw, counted(saw.size())));
}

}  // namespace
}  // namespace contactcheck::mesh
