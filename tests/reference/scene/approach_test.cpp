#include "reference/scene/approach.h"

#include <gmock/gmock.h>

#include "tests/reference/scene/odd_meshes.h"

namespace contactcheck::scene {
namespace {

using test::box_mesh;
using test::odd_meshes;

const std::vector<AxisDirection> kFromRight = {{0, 1.0}};

TEST(Approach, OfTwoBoxesGoesEightPercentDeepAlongTheAxisGiven) {
  const TriangleMesh box = odd_meshes().at("box");
  const auto found = find_approach(box, box, kFromRight);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->robust);
  EXPECT_FALSE(found->turned_about);
  EXPECT_EQ(found->separated, Vec3(1, 0, 0));  // where the faces are on one another
  EXPECT_DOUBLE_EQ(found->depth, 0.08);
  EXPECT_NEAR(found->meeting.x(), 0.92, 1e-12);
}

TEST(Approach, OfABodyHalfAsLargeIsMeasuredByThatBody) {
  const TriangleMesh small = box_mesh(Vec3::Constant(-0.25), Vec3::Constant(0.25), 2);
  const auto found = find_approach(odd_meshes().at("box"), small, {{1, -1.0}});
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->depth, 0.04);
  EXPECT_NEAR(found->meeting.y(), -0.71, 1e-12);
}

// Two plates in one plane share points only as long as rounding leaves them there.
TEST(Approach, OfTwoPlatesInOnePlaneTurnsOneOfThem) {
  const TriangleMesh plate = odd_meshes().at("plate");
  const auto found = find_approach(plate, plate, kFromRight);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->robust);
  EXPECT_TRUE(found->turned_about);
}

// 1 % of their size thick: at 8 % deep, a quarter of that to the side would miss.
TEST(Approach, OfThinRodsIsShallow) {
  const TriangleMesh rod = odd_meshes().at("rod");
  const auto found = find_approach(rod, rod, {{1, 1.0}});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->robust);
  EXPECT_DOUBLE_EQ(found->depth, 0.02);
}

TEST(Approach, OfPointsOnOneLineIsNotRobust) {
  const TriangleMesh needle =
      test::triangle_mesh(Vec3(-0.5, 0, 0), Vec3(0.5, 0, 0), Vec3(0.1, 0, 0));
  const auto found = find_approach(needle, needle, kFromRight);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->robust);
}

// Apart where it says, in contact where it says, for every pair of meshes of about one size.
TEST(Approach, OfOddMeshesLeadsIntoContact) {
  for (const char* a : {"box", "plate", "open", "rod", "leaning"})
    for (const char* b : {"ball", "wall", "plate", "rod", "leaning"}) {
      SCOPED_TRACE(std::string(a) + " and " + b);
      const TriangleMesh &resting = odd_meshes().at(a), &moved = odd_meshes().at(b);
      const auto found = find_approach(resting, moved, {{0, 1.0}, {1, 1.0}, {2, 1.0}});
      ASSERT_TRUE(found);
      EXPECT_TRUE(found->robust);
      if (found->turned_about) continue;
      RigidPair pair(resting, moved);
      EXPECT_TRUE(pair.touches(found->meeting));
      EXPECT_GT(pair.distance(found->separated + 0.01 * found->from.vector()).lower, 0.0099);
    }
}

}  // namespace
}  // namespace contactcheck::scene
