// Pairs of overlapping boxes against brute force.

#include "core/broad/body_pairs.h"

#include <gmock/gmock.h>

#include "tests/support/random_triangles.h"

namespace contactcheck {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<BodyPair> found(const std::vector<Aabb>& boxes) {
  std::vector<BodyPair> out = {{7, 9}};  // must go
  find_candidate_bodies(boxes, out);
  return out;
}

// Ascending by construction.
std::vector<BodyPair> brute_force(const std::vector<Aabb>& boxes) {
  std::vector<BodyPair> out;
  for (std::uint32_t a = 0; a < boxes.size(); ++a)
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
      if (boxes[a].overlaps(boxes[b])) out.push_back({a, b});
  return out;
}

std::vector<Aabb> random_boxes(std::uint64_t seed, int count, const Vec3& spread) {
  test::TriangleSource random(seed);
  std::vector<Aabb> boxes;
  for (int i = 0; i < count; ++i)
    boxes.push_back(random.box(random.point(Vec3::Zero(), 1.0).cwiseProduct(spread), 0.3));
  return boxes;
}

TEST(CandidateBodies, AreNoneWithoutTwoBoxes) {
  EXPECT_THAT(found({}), IsEmpty());
  EXPECT_THAT(found(random_boxes(1, 1, Vec3::Ones())), IsEmpty());
}

TEST(CandidateBodies, AreAscendingPairsHoweverTheBoxesStand) {
  const Aabb left{Vec3::Zero(), Vec3::Ones()}, right{Vec3::Constant(0.5), Vec3::Constant(2)};
  EXPECT_THAT(found({left, right}), ElementsAre(BodyPair{0, 1}));
  EXPECT_THAT(found({right, left}), ElementsAre(BodyPair{0, 1}));
  EXPECT_THAT(found({right, left, right}),
              ElementsAre(BodyPair{0, 1}, BodyPair{0, 2}, BodyPair{1, 2}));
}

TEST(CandidateBodies, AgreeWithBruteForceWhateverTheAxis) {
  for (const Vec3& spread : {Vec3(1, 1, 1), Vec3(9, 1, 1), Vec3(1, 9, 1), Vec3(1, 1, 9)})
    for (int count : {2, 3, 17, 300}) {
      const auto boxes = random_boxes(static_cast<std::uint64_t>(count), count, spread);
      const std::vector<BodyPair> truth = brute_force(boxes);
      if (count == 300) {
        EXPECT_GT(truth.size(), 20u);
        EXPECT_LT(truth.size(), 30000u);
      }
      EXPECT_EQ(found(boxes), truth) << spread.transpose() << " " << count;
    }
}

TEST(CandidateBodies, IncludeBoxesThatTouchAreFlatOrEqual) {
  for (std::uint64_t seed : {21, 22, 23, 24}) {
    test::TriangleSource random(seed);
    std::vector<Aabb> boxes;
    for (int i = 0; i < 300; ++i) boxes.push_back(random.grid_box(4));
    const std::vector<BodyPair> truth = brute_force(boxes);
    EXPECT_GT(truth.size(), 1000u);
    EXPECT_LT(truth.size(), 40000u);
    EXPECT_EQ(found(boxes), truth) << seed;
  }
  const Aabb point{Vec3::Ones(), Vec3::Ones()};
  EXPECT_EQ(found(std::vector<Aabb>(300, point)).size(), 300u * 299 / 2);
}

TEST(CandidateBodies, MissByOneUnitInTheLastPlaceInOneAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    const Aabb unit{Vec3::Zero(), Vec3::Ones()};
    Aabb next = unit;
    next.lo[axis] = 1.0;
    next.hi[axis] = 2.0;
    EXPECT_THAT(found({next, unit}), ElementsAre(BodyPair{0, 1})) << axis;
    next.lo[axis] = std::nextafter(1.0, 2.0);
    EXPECT_THAT(found({next, unit}), IsEmpty()) << axis;
  }
}

TEST(CandidateBodies, AgreeWithBruteForceForHugeAndTinyBoxes) {
  for (double scale : {0x1p-1074, 1e-300, 1e150, 1e307})
    for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(1e300, -1e300, 1.6e308)}) {
      std::vector<Aabb> boxes = random_boxes(31, 60, Vec3(2, 1, 1));
      for (Aabb& box : boxes) box = {scale * box.lo + offset, scale * box.hi + offset};
      boxes.push_back({Vec3::Constant(-1.7e308), Vec3::Constant(1.7e308)});
      EXPECT_EQ(found(boxes), brute_force(boxes)) << scale << " " << offset.transpose();
    }
}

}  // namespace
}  // namespace contactcheck
