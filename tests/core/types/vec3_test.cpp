#include "core/types/vec3.h"

#include <gtest/gtest.h>

#include <cmath>

namespace contactcheck {
namespace {

const Aabb kUnit{Vec3::Zero(), Vec3::Ones()};

TEST(Aabb, OverlapIsClosedOnEveryAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    Aabb other = kUnit;
    other.lo[axis] = 1.0;
    other.hi[axis] = 2.0;
    EXPECT_TRUE(kUnit.overlaps(other) && other.overlaps(kUnit)) << axis;
    other.lo[axis] = std::nextafter(1.0, 2.0);
    EXPECT_FALSE(kUnit.overlaps(other) || other.overlaps(kUnit)) << axis;
  }
}

TEST(Aabb, EmptyHoldsAndMeetsNothing) {
  EXPECT_TRUE(Aabb{}.empty());
  EXPECT_FALSE(Aabb{}.overlaps(kUnit));
  EXPECT_FALSE(Aabb{}.contains(Vec3(0, 0, 0)));
  EXPECT_FALSE(kUnit.empty());
}

TEST(Aabb, ContainsItsBoundary) {
  EXPECT_TRUE(kUnit.contains(Vec3(1, 0, 1)));
  EXPECT_FALSE(kUnit.contains(Vec3(std::nextafter(1.0, 2.0), 0, 1)));
  EXPECT_TRUE(kUnit.contains(kUnit));
  EXPECT_FALSE(kUnit.contains(Aabb{Vec3::Zero(), Vec3(1, 1, 1.5)}));
}

TEST(Aabb, CenterOfHugeBoxDoesNotOverflow) {
  const Aabb box{Vec3::Constant(1e308), Vec3::Constant(1.5e308)};
  EXPECT_DOUBLE_EQ(box.center().x(), 1.25e308);
}

}  // namespace
}  // namespace contactcheck
