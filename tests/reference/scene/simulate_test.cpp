#include "reference/scene/simulate_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/deform/recording.h"
#include "tests/reference/scene/ball_scenes.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::scene {
namespace {

const OnStep kNoReport = [](std::size_t) {};

SimulatedMotion driven_by_itself(const Scene& scene) {
  const std::unique_ptr<Detector> driver = test::core_detector(scene.simulation()->driver);
  return simulate(scene, *driver, kNoReport);
}

bool any_contact(const SimulatedMotion& motion) {
  for (const std::vector<BodyPair>& pairs : motion.reported)
    if (!pairs.empty()) return true;
  return false;
}

TEST(Simulate, TwiceGivesTheSameBits) {
  const Scene scene = test::falling_balls();
  const SimulatedMotion first = driven_by_itself(scene), second = driven_by_itself(scene);
  ASSERT_EQ(first.frames.size(), 30u);
  EXPECT_TRUE(any_contact(first));
  EXPECT_TRUE(test::same_bits(first.frames, second.frames));
  EXPECT_EQ(first.reported, second.reported);
  EXPECT_EQ(first.energy, second.energy);
}

TEST(Simulate, TwoThreadsGiveTheSameBitsAsOne) {
  Scene scene = test::falling_balls();
  const SimulatedMotion one = driven_by_itself(scene);
  scene.simulation()->settings.threads = 2;
  const SimulatedMotion two = driven_by_itself(scene);
  EXPECT_TRUE(any_contact(one));
  EXPECT_TRUE(test::same_bits(one.frames, two.frames));
  EXPECT_EQ(one.energy, two.energy);
}

// The steps are the same ones; only what is kept of them differs.
TEST(Simulate, EveryKeepsTheLastOfSoManySteps) {
  const Scene all = test::falling_balls(18);
  Scene some = test::falling_balls(6);
  some.simulation()->every = 3;
  const SimulatedMotion dense = driven_by_itself(all), sparse = driven_by_itself(some);
  ASSERT_EQ(sparse.frames.size(), 6u);
  ASSERT_EQ(sparse.reported.size(), 6u);
  EXPECT_TRUE(any_contact(sparse));
  for (std::size_t f = 0; f < 6; ++f) {
    EXPECT_TRUE(test::same_bits({sparse.frames[f]}, {dense.frames[3 * f + 2]})) << f;
    EXPECT_EQ(sparse.reported[f], dense.reported[3 * f + 2]) << f;
  }
  EXPECT_EQ(sparse.energy, dense.energy);
  EXPECT_EQ(sparse.energy.size(), 19u);
}

TEST(Simulate, TellsEveryStepAndGivesItToTheDriverOnce) {
  Scene scene = test::falling_balls(4);
  scene.simulation()->every = 2;
  test::BlindDetector driver(Question::kTriangles);
  std::vector<std::size_t> told;
  simulate(scene, driver, [&](std::size_t step) { told.push_back(step); });
  std::vector<std::size_t> wanted(8);
  std::iota(wanted.begin(), wanted.end(), std::size_t{0});
  EXPECT_EQ(told, wanted);
  for (std::size_t& step : wanted) ++step;  // the state after so many steps
  EXPECT_EQ(driver.frames(), wanted);
  EXPECT_EQ(driver.asked(), std::vector<Question>(8, Question::kTriangles));
}

TEST(Simulate, EnergyAndSpeedOfAFallAreInClosedForm) {
  Scene scene = test::falling_balls(30);
  test::BlindDetector driver(Question::kCells);
  const SimulatedMotion motion = simulate(scene, driver, kNoReport);
  // Half a second with 9.81 m/s^2, from 1 m/s and from rest, of 1 kg each.
  const double upper = 1.0 + 4.905, lower = 4.905;
  const double kinetic = 0.5 * (upper * upper + lower * lower);
  EXPECT_NEAR(motion.highest_kinetic, kinetic, 1e-9);
  EXPECT_NEAR(motion.last_speed, std::sqrt(kinetic), 1e-9);
  ASSERT_EQ(motion.energy.size(), 31u);
  for (double energy : motion.energy) EXPECT_NEAR(energy, 0.5 * 1.0 + 9.81 * 0.25, 1e-9);
}

Recording recording_of(const Scene& scene, const SimulatedMotion& motion) {
  const double step = scene.time_step * static_cast<double>(scene.simulation()->every);
  return {scene.id, scene.bodies, step, motion.frames};
}

TEST(Simulate, ItsRecordingReplaysWithTheSameBits) {
  const Scene scene = test::falling_balls();
  const SimulatedMotion motion = driven_by_itself(scene);
  const test::Scratch scratch;
  const auto file = scratch.folder() / "balls.ccr";
  write_recording(file, recording_of(scene, motion));
  const Scene replay = load_recording(file);
  EXPECT_EQ(replay.id, scene.id);
  EXPECT_EQ(replay.simulation(), nullptr);
  ASSERT_EQ(replay.frames, scene.frames);
  EXPECT_TRUE(test::same_bits(replay.recorded, motion.frames));
  EXPECT_TRUE(test::same_bits({replay.nodes_of_frame(17)}, {motion.frames[17]}));
}

// A detector that is given the replay answers as it did in the loop.
TEST(Simulate, TheDriverReportsInTheReplayWhatItReportedInTheLoop) {
  const Scene scene = test::falling_balls();
  const SimulatedMotion motion = driven_by_itself(scene);
  const test::Scratch scratch;
  const auto file = scratch.folder() / "balls.ccr";
  write_recording(file, recording_of(scene, motion));
  const Scene replay = load_recording(file);
  const std::unique_ptr<Detector> driver = test::core_detector(scene.simulation()->driver);
  driver->prepare(replay.bodies);
  for (std::size_t f = 0; f < replay.frames; ++f) {
    const test::FrameData data = test::make_frame(replay.bodies, replay.nodes_of_frame(f));
    const Frame frame = data.frame(f);
    driver->update(frame);
    ContactSet contacts;
    driver->query(Question::kTriangles, contacts);
    contacts.canonicalize();
    EXPECT_EQ(contacts.bodies, motion.reported[f]) << f;
  }
  EXPECT_TRUE(any_contact(motion));
}

}  // namespace
}  // namespace contactcheck::scene
