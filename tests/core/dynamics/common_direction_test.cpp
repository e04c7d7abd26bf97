#include "core/dynamics/contact_point.h"

#include <gtest/gtest.h>

namespace contactcheck {
namespace {

ContactPoint point_along(std::uint32_t a, std::uint32_t b, const Vec3& normal) {
  return {a, b, {}, {}, normal, 0.25};
}

TEST(CommonDirection, TurnsOnlyWhatIsMoreThanSixtyDegreesOff) {
  const Vec3 near(0.6, 0.8, 0.0), across(0.8, 0.0, 0.6), against(0.0, -1.0, 0.0);
  std::vector<ContactPoint> points = {point_along(0, 1, near), point_along(0, 1, across),
                                      point_along(0, 1, against)};
  agree_on_directions({{{0, 1}, Vec3(0.0, 7.0, 0.0)}}, points);
  EXPECT_EQ(points[0].normal, near);
  EXPECT_EQ(points[1].normal, Vec3::UnitY());
  EXPECT_EQ(points[2].normal, Vec3::UnitY());
  for (const ContactPoint& point : points) EXPECT_EQ(point.depth, 0.25);
}

TEST(CommonDirection, OfOtherBodiesAndOfZeroSaysNothing) {
  std::vector<ContactPoint> points = {point_along(0, 1, Vec3::UnitX()),
                                      point_along(1, 2, Vec3::UnitX())};
  agree_on_directions({{{0, 1}, Vec3::Zero()}, {{0, 2}, Vec3(-1, 0, 0)}}, points);
  EXPECT_EQ(points[0].normal, Vec3::UnitX());
  EXPECT_EQ(points[1].normal, Vec3::UnitX());
}

}  // namespace
}  // namespace contactcheck
