#include "core/dynamics/held_contacts.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/core/dynamics/contact_cases.h"
#include "tests/support/random_triangles.h"

namespace contactcheck {
namespace {

using test::random_blend;
using test::same_bits;

// Two bodies that are clouds of nodes; empty masses: cannot be moved.
struct Sides {
  std::array<NodeState, 2> states;
  std::array<std::vector<double>, 2> masses;
  double friction = 0.0;

  std::vector<ResponseBody> bodies() {
    std::vector<ResponseBody> out(2);
    for (int b = 0; b < 2; ++b) out[b] = {&states[b], masses[b], 0.0, friction};
    return out;
  }
  HeldContacts held(const std::vector<ContactPoint>& points) {
    HeldContacts out;
    out.hold(points, bodies());
    return out;
  }
  void stop_approach(const HeldContacts& held) {
    std::vector<ResponseBody> movers = bodies();
    held.stop_approach(movers);
  }
  Vec3 momentum() const {
    Vec3 out = Vec3::Zero();
    for (int b = 0; b < 2; ++b)
      for (std::size_t n = 0; n < masses[b].size(); ++n)
        out += masses[b][n] * states[b].velocities[n];
    return out;
  }
  double kinetic_energy() const {
    double out = 0.0;
    for (int b = 0; b < 2; ++b)
      for (std::size_t n = 0; n < masses[b].size(); ++n)
        out += 0.5 * masses[b][n] * states[b].velocities[n].squaredNorm();
    return out;
  }
};

// Two bodies of one node each, the second 1 m along x from the first.
Sides two_masses(double mass_a, const Vec3& velocity_a, double mass_b, const Vec3& velocity_b) {
  Sides sides;
  sides.states = {NodeState{{Vec3::Zero()}, {velocity_a}},
                  NodeState{{Vec3::UnitX()}, {velocity_b}}};
  sides.masses = {std::vector<double>{mass_a}, std::vector<double>{mass_b}};
  return sides;
}

// Their nodes, separated along x.
ContactPoint along_x() { return {0, 1, {{0}, {1.0}}, {{0}, {1.0}}, Vec3::UnitX(), 0.0}; }

bool same_velocities(const Sides& x, const Sides& y) {
  return same_bits(x.states[0].velocities, y.states[0].velocities) &&
         same_bits(x.states[1].velocities, y.states[1].velocities);
}

// Two bodies of eight nodes that come nearer, with masses between 0.1 and 1.9 kg.
constexpr std::uint32_t kNodes = 8;

Sides random_sides(test::TriangleSource& random) {
  Sides sides;
  for (int b = 0; b < 2; ++b) {
    const double side = b == 0 ? -1.0 : 1.0;
    for (std::uint32_t n = 0; n < kNodes; ++n) {
      sides.states[b].positions.push_back(random.point(Vec3(side, 0, 0), 1.0));
      sides.states[b].velocities.push_back(random.point(Vec3(-3.0 * side, 0, 0), 4.0));
      sides.masses[b].push_back(1.0 + 0.9 * random.unit());
    }
  }
  return sides;
}

// Normals within 45 degrees of x.
std::vector<ContactPoint> random_points(test::TriangleSource& random, int count) {
  std::vector<ContactPoint> points;
  for (int i = 0; i < count; ++i) {
    const Vec3 normal = (Vec3::UnitX() + 0.7 * random.point(Vec3::Zero(), 1.0)).normalized();
    points.push_back(
        {0, 1, random_blend(random, kNodes), random_blend(random, kNodes), normal, 0.0});
  }
  return points;
}

TEST(HeldContacts, StopApproachAtTheCommonSpeed) {
  Sides sides = two_masses(2.0, {3, 0, 0}, 1.0, {-3, 0, 0});
  sides.stop_approach(sides.held({along_x()}));
  // (2 * 3 - 1 * 3) / (2 + 1): they go on together.
  EXPECT_DOUBLE_EQ(sides.states[0].velocities[0].x(), 1.0);
  EXPECT_DOUBLE_EQ(sides.states[1].velocities[0].x(), 1.0);
}

TEST(HeldContacts, LeaveSeparationAndRestAlone) {
  for (double speed : {0.0, 0.5}) {
    Sides sides = two_masses(2.0, {-speed, 0.25, 0}, 1.0, {speed, 0, 0.75});
    sides.friction = 1.0;
    const Sides before = sides;
    sides.stop_approach(sides.held({along_x()}));
    EXPECT_TRUE(same_velocities(sides, before)) << speed;
  }
}

TEST(HeldContacts, SidesThatCameApartMayComeBackButNoNearer) {
  Sides sides = two_masses(1.0, Vec3::UnitX(), 1.0, -Vec3::UnitX());
  const HeldContacts held = sides.held({along_x()});
  const Sides start = sides;
  sides.states[1].positions[0].x() = std::nextafter(1.0, 2.0);
  sides.stop_approach(held);
  EXPECT_TRUE(same_velocities(sides, start));
  for (double back : {1.0, 0.875}) {
    Sides again = start;
    again.states[1].positions[0].x() = back;
    again.stop_approach(held);
    EXPECT_EQ(again.states[0].velocities[0], Vec3::Zero()) << back;
    EXPECT_EQ(again.states[1].velocities[0], Vec3::Zero()) << back;
  }
}

TEST(HeldContacts, MeasureSeparationAlongTheNormalAlone) {
  Sides sides = two_masses(1.0, Vec3::UnitX(), 1.0, -Vec3::UnitX());
  const HeldContacts held = sides.held({along_x()});
  sides.states[1].positions[0].y() = 5.0;  // far off, and no farther along x
  sides.stop_approach(held);
  EXPECT_EQ(sides.states[1].velocities[0], Vec3::Zero());
}

TEST(HeldContacts, ConserveMomentumAndNeverGainEnergy) {
  test::TriangleSource random(91);
  int lossy = 0;
  for (int round = 0; round < 200; ++round) {
    Sides sides = random_sides(random);
    sides.friction = 0.01 * round;
    const Vec3 momentum = sides.momentum();
    const double energy = sides.kinetic_energy();
    sides.stop_approach(sides.held(random_points(random, 20)));
    EXPECT_LE((sides.momentum() - momentum).norm(), 1e-12);
    // Rounding of a sum of some hundred joules.
    EXPECT_LE(sides.kinetic_energy(), energy * (1.0 + 1e-14));
    if (sides.kinetic_energy() < 0.9 * energy) ++lossy;
  }
  // The points do something in most rounds.
  EXPECT_GT(lossy, 100);
}

TEST(HeldContacts, BlendsAreStoppedAtThePointNotAtTheNodes) {
  test::TriangleSource random(92);
  for (int round = 0; round < 50; ++round) {
    Sides sides = random_sides(random);
    const ContactPoint point = random_points(random, 1)[0];
    const auto speed = [&] {
      return (test::blended(point.b, sides.states[1].velocities) -
              test::blended(point.a, sides.states[0].velocities))
          .dot(point.normal);
    };
    ASSERT_LT(speed(), -0.1);
    sides.stop_approach(sides.held({point}));
    EXPECT_NEAR(speed(), 0.0, 1e-13);
  }
}

// Stopping 4 m/s of approach may take 4 m/s times the coefficient of the sliding.
TEST(HeldContacts, FrictionTakesSlidingOnlyWithinTheCone) {
  for (double friction : {0.0, 0.25, 0.5}) {
    Sides sides = two_masses(1.0, {4, 0, 0}, 1.0, {0, 3, 4});  // slides with 5 m/s
    sides.friction = friction;
    sides.stop_approach(sides.held({along_x()}));
    const Vec3 after = sides.states[1].velocities[0] - sides.states[0].velocities[0];
    const Vec3 wanted = Vec3(0, 0.6, 0.8) * (5.0 - friction * 4.0);
    EXPECT_LE((after - wanted).norm(), 1e-14) << friction;
  }
}

TEST(HeldContacts, FrictionStopsSlidingAndDoesNotTurnItRound) {
  for (double friction : {1.25, 10.0}) {
    Sides sides = two_masses(1.0, {4, 0, 0}, 3.0, {0, 3, 4});
    sides.friction = friction;
    sides.stop_approach(sides.held({along_x()}));
    const Vec3 after = sides.states[1].velocities[0] - sides.states[0].velocities[0];
    EXPECT_LE(after.norm(), 1e-14) << friction;
  }
}

TEST(HeldContacts, UseTheGeometricMeanOfTheFrictions) {
  Sides sides = two_masses(1.0, {4, 0, 0}, 1.0, {0, 5, 0});
  std::vector<ResponseBody> bodies = sides.bodies();
  bodies[0].friction = 0.25;
  bodies[1].friction = 1.0;
  HeldContacts held;
  held.hold({along_x()}, bodies);
  held.stop_approach(bodies);
  const Vec3 after = sides.states[1].velocities[0] - sides.states[0].velocities[0];
  EXPECT_LE((after - Vec3(0, 3, 0)).norm(), 1e-14);
}

TEST(HeldContacts, AnImmovableSideStaysAndTheOtherIsStopped) {
  for (int fixed : {0, 1}) {
    Sides sides = two_masses(1.0, {3, 0, 0}, 1.0, {-3, 0, 0});
    sides.masses[fixed].clear();
    sides.states[fixed].velocities[0] = Vec3::Zero();
    const NodeState before = sides.states[fixed];
    sides.stop_approach(sides.held({along_x()}));
    EXPECT_TRUE(same_bits(sides.states[fixed].velocities, before.velocities));
    EXPECT_TRUE(same_bits(sides.states[fixed].positions, before.positions));
    EXPECT_EQ(sides.states[1 - fixed].velocities[0], Vec3::Zero());
  }
}

TEST(HeldContacts, PointsBetweenImmovableBodiesAreNotHeld) {
  Sides sides = two_masses(1.0, Vec3::Zero(), 1.0, Vec3::Zero());
  for (std::vector<double>& masses : sides.masses) masses.clear();
  EXPECT_TRUE(sides.held({along_x()}).empty());
}

TEST(HeldContacts, ForgetTheFormerPoints) {
  Sides sides = two_masses(1.0, Vec3::UnitX(), 1.0, -Vec3::UnitX());
  HeldContacts held = sides.held({along_x()});
  EXPECT_FALSE(held.empty());
  held.hold({}, sides.bodies());
  EXPECT_TRUE(held.empty());
  const Sides before = sides;
  sides.stop_approach(held);
  EXPECT_TRUE(same_velocities(sides, before));
}

}  // namespace
}  // namespace contactcheck
