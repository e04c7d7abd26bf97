#include "reference/judge/closed_loop.h"

#include <gmock/gmock.h>

#include "tests/reference/judge/two_balls.h"

namespace contactcheck::judge {
namespace {

using test::Blind;
using test::falling_balls;
using test::kBallRadius;
using test::shot;
using test::TruthfulDetector;
using test::two_balls;

// Long enough for the shot ball to come out on the other side where nothing stops it.
constexpr std::size_t kShotFrames = 30;

template <typename Driver, typename... Arguments>
results::ClosedLoop drive(const scene::Scene& scene, Arguments... arguments) {
  process::SharedProgress page;
  process::ProgressWriter progress(&page);
  return run_closed_loop(
      scene, 0, [&] { return std::make_unique<Driver>(arguments...); }, progress);
}

TEST(ClosedLoop, ExactDriverLetsNothingThroughAndMissesNothing) {
  const results::ClosedLoop loop = drive<TruthfulDetector>(falling_balls(40));
  EXPECT_EQ(loop.error, "");
  EXPECT_EQ(loop.steps, 40u);
  EXPECT_GT(loop.levels.at(Level::kTriangle).truth, 20u);
  EXPECT_TRUE(loop.levels.at(Level::kTriangle).perfect());
  EXPECT_TRUE(loop.levels.at(Level::kBody).perfect());
  EXPECT_EQ(loop.tunnelling_events, 0u);
  ASSERT_TRUE(loop.deepest_penetration.has_value());
  EXPECT_LT(*loop.deepest_penetration, 0.4 * kBallRadius);
}

TEST(ClosedLoop, PairThatTouchesDoesNotHover) {
  // After 8 steps of 4/60 m the centres are 0.47 m apart: the last frame is the first contact.
  const results::ClosedLoop loop = drive<TruthfulDetector>(shot(8));
  EXPECT_EQ(loop.hover_at_rest_max, 0.0);
  EXPECT_EQ(loop.hover_at_rest_mean, 0.0);
}

TEST(ClosedLoop, JudgesTheMotionOfTheDriverAndNotThatOfTheScene) {
  scene::Scene scene = shot(kShotFrames);
  scene.recorded.assign(kShotFrames, scene.nodes_at(0.0));  // somebody else's: nothing ever moves
  EXPECT_GT(drive<TruthfulDetector>(scene).levels.at(Level::kTriangle).truth, 0u);
}

TEST(ClosedLoop, ShotBallIsStoppedByAnExactDriver) {
  const results::ClosedLoop loop = drive<TruthfulDetector>(shot(kShotFrames));
  EXPECT_GT(loop.levels.at(Level::kTriangle).truth, 0u);
  EXPECT_EQ(loop.tunnelling_events, 0u);
  EXPECT_LT(loop.last_speed, 4.0) << "m/s, when only one ball moved";
}

TEST(ClosedLoop, BlindDriverLetsABallThroughOnce) {
  const results::ClosedLoop loop = drive<Blind>(shot(kShotFrames));
  EXPECT_EQ(loop.error, "");
  EXPECT_EQ(loop.tunnelling_events, 1u);
  ASSERT_TRUE(loop.deepest_penetration.has_value());
  EXPECT_GT(*loop.deepest_penetration, 0.5 * kBallRadius);
  EXPECT_LE(*loop.deepest_penetration, 2.0 * kBallRadius);
  EXPECT_EQ(loop.hover_at_rest_max, std::nullopt) << "it reports no pair";
  EXPECT_EQ(loop.hover_at_rest_mean, std::nullopt);
  EXPECT_GT(loop.levels.at(Level::kTriangle).truth, 0u);
  EXPECT_EQ(loop.levels.at(Level::kTriangle).hit, 0u);
}

// While it was wholly inside, it was taken to have left.
TEST(ClosedLoop, SmallBallThroughALargeOneIsOnePassage) {
  scene::Scene scene = shot(kShotFrames);
  scene.bodies[1].shape =
      test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.05, 1), {2, 2, 2}).shape;
  EXPECT_EQ(drive<Blind>(scene).tunnelling_events, 1u);
}

TEST(ClosedLoop, ContainedPairDoesNotHoverForADetectorOfSolids) {
  scene::Scene scene = two_balls({}, {{0.02, 0.0, 0.0}, {}}, 10);
  scene.bodies[1].shape =
      test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.05, 1), {2, 2, 2}).shape;
  const results::ClosedLoop solid = drive<test::ReportsFirstTwo>(scene, true);
  EXPECT_EQ(solid.hover_at_rest_max, 0.0);
  EXPECT_TRUE(solid.levels.at(Level::kBody).perfect());
  EXPECT_GT(*drive<test::ReportsFirstTwo>(scene, false).hover_at_rest_max, 0.1);
}

TEST(ClosedLoop, PenetrationIsUnknownWhereVerticesAreNotJudged) {
  scene::Scene scene = shot(17);
  scene.levels = {Level::kBody, Level::kTriangle};
  EXPECT_EQ(drive<Blind>(scene).deepest_penetration, std::nullopt);
}

TEST(ClosedLoop, BallsThatAreStillInContactAtTheEndHaveNotTunnelled) {
  // 17 steps of 4/60 m: the centres have passed (1.13 m of 1 m), the surfaces have not separated.
  const results::ClosedLoop loop = drive<Blind>(shot(17));
  EXPECT_EQ(loop.tunnelling_events, 0u);
  EXPECT_GT(*loop.deepest_penetration, 0.5 * kBallRadius);
}

TEST(ClosedLoop, EveryPassageCounts) {
  // Three balls in a row along x, the first shot through both others.
  scene::Scene scene = shot(2 * kShotFrames);
  scene.bodies.push_back({"third", scene.bodies[0].shape});
  scene.origins.push_back({"third", "code", ""});
  scene.motions.push_back(scene.motions[0]);
  scene.motions.back().path.position[0].keys = {{0.0, 1.0}};
  scene.simulation()->materials.push_back(scene.simulation()->materials[0]);
  scene.simulation()->velocities.push_back(Vec3::Zero());
  EXPECT_EQ(drive<Blind>(scene).tunnelling_events, 2u);
}

TEST(ClosedLoop, HoverIsTheTrueDistanceOfAPairThatIsReportedTooEarly) {
  // Nothing moves by itself; the triangles 0 and 100 lie far apart, and a report parts the balls.
  const double gap = 0.3;
  const scene::Scene scene = two_balls({}, {{2.0 * kBallRadius + gap, 0.0, 0.0}, {}}, 10);
  const results::ClosedLoop loop = drive<test::Invents>(scene, ElementPair{0, 1, 0, 100});
  ASSERT_TRUE(loop.hover_at_rest_max.has_value());
  EXPECT_GE(*loop.hover_at_rest_max, gap) << "an invented contact pushes apart";
  EXPECT_EQ(loop.hover_at_rest_mean, loop.hover_at_rest_max) << "a tenth of ten frames is one";
  EXPECT_EQ(loop.deepest_penetration, 0.0);
  EXPECT_EQ(loop.levels.at(Level::kTriangle).spurious, 10u);
}

TEST(ClosedLoop, BodiesThatCannotBeMovedHaveNoEnergyGainToSpeakOf) {
  scene::Scene scene = shot(5);
  for (auto& material : scene.simulation()->materials) material.reset();
  const results::ClosedLoop loop = drive<Blind>(scene);
  EXPECT_EQ(loop.energy_gain, std::nullopt);
  EXPECT_EQ(loop.last_speed, 0.0);
}

TEST(ClosedLoop, FreeFlightKeepsItsEnergyAndItsSpeed) {
  const scene::Scene apart =
      two_balls({{0.0, 3.0, 0.0}, {1.0, 0.0, 0.0}}, {{}, {1.0, 0.0, 0.0}}, 5);
  const results::ClosedLoop loop = drive<Blind>(apart);
  ASSERT_TRUE(loop.energy_gain.has_value());
  EXPECT_NEAR(*loop.energy_gain, 0.0, 1e-12);
  EXPECT_NEAR(loop.last_speed, 1.0, 1e-12);
}

TEST(ClosedLoop, OpenBodiesHaveNoPenetration) {
  scene::Scene scene = shot(3);
  TriangleMesh open = scene.bodies[0].shape->mesh;
  open.triangles.pop_back();
  for (Body& body : scene.bodies) body.shape = test::make_body("", open, {2, 2, 2}).shape;
  EXPECT_EQ(drive<Blind>(scene).deepest_penetration, std::nullopt);
}

TEST(ClosedLoop, FramesAreEveryNthStep) {
  scene::Scene scene = shot(6);
  scene.simulation()->every = 3;
  EXPECT_EQ(drive<Blind>(scene).steps, 18u);
}

TEST(ClosedLoop, MotionThatDivergesIsAResultAndNoException) {
  scene::Scene scene = shot(5);
  scene.simulation()->settings.gravity = Vec3(0.0, -1e12, 0.0);
  const results::ClosedLoop loop = drive<TruthfulDetector>(scene);
  EXPECT_THAT(loop.error, testing::HasSubstr("diverged"));
  EXPECT_THAT(loop.error, testing::HasSubstr("\"first\""));
  EXPECT_TRUE(loop.levels.empty());
  EXPECT_EQ(loop.steps, 0u);
}

TEST(ClosedLoop, WhatTheDriverThrowsPassesThrough) {
  EXPECT_THROW(drive<test::Throws>(shot(kShotFrames)), std::runtime_error);
}

}  // namespace
}  // namespace contactcheck::judge
