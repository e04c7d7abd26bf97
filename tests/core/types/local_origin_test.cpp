#include "core/types/local_origin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/types/check.h"

namespace contactcheck {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();

Frame frame_of(const std::vector<std::vector<Vec3>>& bodies) {
  Frame frame;
  for (const std::vector<Vec3>& nodes : bodies) frame.bodies.push_back({nodes, {}});
  return frame;
}

TEST(LocalOrigin, IsTheCentreOfTheBoxRoundAllNodes) {
  const std::vector<std::vector<Vec3>> bodies = {{{1, 2, 3}, {2, 2, 2}}, {{5, -2, 3}}};
  EXPECT_EQ(local_origin(frame_of(bodies)), Vec3(3, 0, 2.5));
  EXPECT_EQ(local_origin(frame_of({bodies[1], bodies[0]})), Vec3(3, 0, 2.5));
}

TEST(LocalOrigin, IsZeroWithoutBodiesOrNodes) {
  EXPECT_EQ(local_origin(Frame{}), Vec3::Zero());
  EXPECT_EQ(local_origin(frame_of({{}, {}})), Vec3::Zero());
}

TEST(LocalOrigin, OverflowsNeitherItselfNorInDistances) {
  const std::vector<std::vector<Vec3>> bodies = {{Vec3::Constant(kLargest), Vec3(0, 0, kLargest)},
                                                 {Vec3(-kLargest, 0, kLargest)}};
  const Vec3 origin = local_origin(frame_of(bodies));
  EXPECT_EQ(origin, Vec3(0, 0.5 * kLargest, kLargest));
  for (const std::vector<Vec3>& nodes : bodies)
    for (const Vec3& node : nodes) EXPECT_TRUE((node - origin).allFinite());
}

// 1e9 + 1e-3 is no float, and the float nearest to 1e-3 is not what is left of it in double.
TEST(LocalValue, SubtractsInDoubleAndRoundsOnce) {
  const double x = 1e9 + 1e-3;
  const volatile float value = local_value(x, 1e9);
  EXPECT_EQ(value, static_cast<float>(x - 1e9));
  EXPECT_NEAR(value, 1e-3, 1e-7);
}

TEST(RoundToLocal, RoundsEveryCoordinateAboutTheOrigin) {
  const std::vector<Vec3> points = {{1e6 + 0.1, 0.2, -7}, {1e6, 1, 0}};
  std::vector<Vec3f> out(2);
  round_to_local(points, Vec3(1e6, 0, 1), out);
  EXPECT_EQ(out[0], Vec3f(static_cast<float>((1e6 + 0.1) - 1e6), 0.2f, -8.0f));
  EXPECT_EQ(out[1], Vec3f(0, 1, -1));
}

TEST(RoundToLocal, RefusesWhatSinglePrecisionCannotMultiply) {
  std::vector<Vec3f> out(1);
  const double limit = kSingleLimit;
  const std::vector<Vec3> last = {Vec3(limit, -limit, 0)};
  EXPECT_NO_THROW(round_to_local(last, Vec3::Zero(), out));
  for (double beyond : {std::nextafter(limit, kLargest), -1e39, kLargest}) {
    const std::vector<Vec3> far = {Vec3(0, beyond, 0)};
    EXPECT_THROW(round_to_local(far, Vec3::Zero(), out), RefusedInput) << beyond;
    EXPECT_NO_THROW(round_to_local(far, Vec3(0, beyond, 0), out)) << beyond;
  }
}

}  // namespace
}  // namespace contactcheck
