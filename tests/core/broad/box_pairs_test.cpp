#include "core/broad/box_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/random_triangles.h"

namespace contactcheck {
namespace {

using Pairs = std::vector<BoxPairFinder::Pair>;

Pairs by_brute_force(const std::vector<OwnedBox>& boxes, bool own = false) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if ((boxes[i].body == boxes[j].body) == own && boxes[i].box.overlaps(boxes[j].box))
        pairs.emplace_back(i, j);
  return pairs;
}

// Sorted, but with repeats, should there be any.
Pairs found(const std::vector<OwnedBox>& boxes, double cell_size, std::uint32_t table_size = 0,
            double largest = 64, bool own = false) {
  BoxPairFinder finder;
  BoxPairSettings settings;
  settings.cell_size = cell_size;
  settings.table_size = table_size;
  settings.largest_buckets_per_box = largest;
  settings.own = own;
  Pairs pairs;
  finder.find(boxes, settings, pairs);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

struct Cloud {
  Vec3 center = Vec3::Zero();
  double spread = 2.0;  // of the boxes of size about 1 round the centre
  double scale = 1.0;
  int oversize = 0;  // boxes of 40 times the size
};

std::vector<OwnedBox> random_boxes(const Cloud& cloud) {
  test::TriangleSource random(51);
  std::vector<OwnedBox> boxes;
  for (int i = 0; i < 150; ++i) {
    const Vec3 middle = cloud.center + random.point(Vec3::Zero(), cloud.spread * cloud.scale);
    const double size = (i < cloud.oversize ? 40.0 : 0.6) * cloud.scale;
    boxes.push_back({random.box(middle, size), static_cast<std::uint32_t>(random.below(3)), 0});
  }
  return boxes;
}

std::vector<Cloud> clouds() {
  return {{},
          {Vec3(-50, 7, -0.5)},
          {Vec3(-1e6, 1e6, 0), 2.0, 1.0, 4},
          {Vec3(1e15, 0, 0)},             // a coordinate's ulp is 1/8
          {Vec3(0, -1e300, 1e300), 2.0},  // all boxes flat there, keys at their limit
          {Vec3::Zero(), 2.0, 1e-9, 2},
          {Vec3::Zero(), 2.0, 1e200, 2}};
}

TEST(BoxPairFinder, EqualsBruteForceAtEveryGridAndTableSize) {
  for (const Cloud& cloud : clouds()) {
    const std::vector<OwnedBox> boxes = random_boxes(cloud);
    const Pairs expected = by_brute_force(boxes);
    EXPECT_GT(expected.size(), 50u);
    EXPECT_LT(expected.size(), boxes.size() * boxes.size() / 2);
    for (double cell : {0.01, 1.0, 100.0})
      for (std::uint32_t table : {0u, 1u, 64u})
        EXPECT_EQ(found(boxes, cell * cloud.scale, table), expected)
            << cloud.center.transpose() << " cell " << cell << " table " << table;
  }
}

TEST(BoxPairFinder, EqualsBruteForceWithAndWithoutOversizeList) {
  const std::vector<OwnedBox> boxes = random_boxes({Vec3(-1, -2, -3), 2.0, 1.0, 0});
  const Pairs expected = by_brute_force(boxes);
  for (double largest : {0.0, 1.0, 8.0, 1e4})  // 0: every box is oversize
    EXPECT_EQ(found(boxes, 0.2, 0, largest), expected) << largest;
}

TEST(BoxPairFinder, EqualsBruteForceWhereFacesLieOnGridLines) {
  test::TriangleSource random(52);
  std::vector<OwnedBox> boxes;
  for (std::uint32_t i = 0; i < 100; ++i) boxes.push_back({random.grid_box(4), i % 2, 0});
  const Pairs expected = by_brute_force(boxes);
  EXPECT_GT(expected.size(), 100u);
  for (double cell : {0.5, 1.0, 2.0, 2.0}) EXPECT_EQ(found(boxes, cell), expected) << cell;
}

TEST(BoxPairFinder, TouchingCornersAreAPairAndOneUlpApartIsNone) {
  for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1, -1, 2), Vec3(0.3, -0.7, 1e5)}) {
    std::vector<OwnedBox> boxes = {{{corner - Vec3::Ones(), corner}, 0, 0},
                                   {{corner, corner + Vec3::Ones()}, 1, 0}};
    EXPECT_EQ(found(boxes, 1.0).size(), 1u);
    boxes[1].box.lo.z() = std::nextafter(corner.z(), 1e308);
    EXPECT_TRUE(found(boxes, 1.0).empty());
  }
}

TEST(BoxPairFinder, FindsThoseOfOneBodyWhereAskedTo) {
  for (const Cloud& cloud : clouds()) {
    const std::vector<OwnedBox> boxes = random_boxes(cloud);
    const Pairs expected = by_brute_force(boxes, true);
    EXPECT_FALSE(expected.empty());
    for (const double largest : {1.0, 64.0})
      EXPECT_EQ(found(boxes, 0.7 * cloud.scale, 0, largest, true), expected);
  }
}

TEST(BoxPairFinder, BoxesOfOneBodyAreNoPair) {
  const Aabb box{Vec3::Zero(), Vec3::Ones()};
  EXPECT_TRUE(found({{box, 4, 0}, {box, 4, 1}}, 1.0).empty());
  EXPECT_TRUE(found({{box, 4, 0}, {box, 4, 1}}, 0.01).empty());  // both oversize
}

TEST(BoxPairFinder, AppendsAndForgetsTheLastCall) {
  const Aabb box{Vec3::Zero(), Vec3::Ones()};
  BoxPairFinder finder;
  Pairs pairs = {{7, 9}};
  finder.find({{box, 0, 0}, {box, 1, 0}, {box, 2, 0}}, {}, pairs);
  EXPECT_EQ(pairs.size(), 4u);
  finder.find({{box, 0, 0}, {box, 1, 0}}, {}, pairs);
  EXPECT_EQ(pairs.size(), 5u);
  EXPECT_EQ(pairs.back(), (BoxPairFinder::Pair{0, 1}));
}

TEST(BoxPairFinder, EmptyBoxesMeetNothing) {
  const Aabb box{Vec3::Zero(), Vec3::Ones()};
  EXPECT_TRUE(found({{Aabb{}, 0, 0}, {box, 1, 0}, {Aabb{}, 2, 0}}, 1.0).empty());
}

}  // namespace
}  // namespace contactcheck
