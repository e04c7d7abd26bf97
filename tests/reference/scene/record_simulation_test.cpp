// From a scene with a driver's name to its recorded frames, and what is said when that fails.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "reference/scene/simulate_scene.h"
#include "tests/reference/scene/ball_scenes.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::scene {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const OnStep kSilent = [](std::size_t) {};

std::string fault_of(Scene scene, const DetectorCatalog& catalog = test::core_catalog()) {
  return test::sentence_of([&] { record_simulation(catalog, kSilent, scene); });
}

TEST(RecordSimulation, FillsTheFramesByTheScenesOwnDriver) {
  Scene scene = test::falling_balls();
  const std::unique_ptr<Detector> driver = test::core_detector(scene.simulation()->driver);
  const SimulatedMotion motion = simulate(scene, *driver, kSilent);
  std::size_t steps = 0;
  record_simulation(
      test::core_catalog(), [&](std::size_t) { ++steps; }, scene);
  EXPECT_EQ(steps, 30u);
  EXPECT_TRUE(test::same_bits(scene.recorded, motion.frames));
  EXPECT_TRUE(test::same_bits({scene.nodes_of_frame(29)}, {motion.frames[29]}));
}

TEST(RecordSimulation, HasNothingToDoForScriptedScenes) {
  Scene scene = test::falling_balls();
  scene.kind = GivenFrames{};
  int steps = 0;
  record_simulation(
      DetectorCatalog(), [&](std::size_t) { ++steps; }, scene);
  EXPECT_EQ(steps, 0);
  EXPECT_TRUE(scene.recorded.empty());
  EXPECT_TRUE(scene.scripted());
}

TEST(RecordSimulation, AnUnknownDriverIsNamedWithItsScene) {
  Scene scene = test::falling_balls(2);
  scene.simulation()->driver = "ffd-crystal-ball";
  EXPECT_THAT(fault_of(scene), AllOf(StartsWith("scene \"test-balls\", driver ffd-crystal-ball: "),
                                     HasSubstr("unknown detector")));
  EXPECT_TRUE(scene.recorded.empty());
}

TEST(RecordSimulation, AnUnknownOptionOfTheDriverIsNamedWithItsScene) {
  Scene scene = test::falling_balls(2);
  scene.simulation()->driver = "ffd-grid:colour=red";
  EXPECT_THAT(fault_of(scene), AllOf(StartsWith("scene \"test-balls\", driver ffd-grid:colour=red"),
                                     HasSubstr("unknown option \"colour\"")));
}

TEST(RecordSimulation, AnAbsentDriverIsNamedWithTheReason) {
  DetectorCatalog catalog;
  DetectorInfo info = test::blind_info("blind", Question::kTriangles);
  info.absent_because = "not built here";
  catalog.add(info);
  Scene scene = test::falling_balls(2);
  scene.simulation()->driver = "blind";
  EXPECT_EQ(fault_of(scene, catalog), "scene \"test-balls\", driver blind: not built here");
}

TEST(RecordSimulation, ADriverThatCannotDriveOrRefusesIsNamedWithTheReason) {
  DetectorCatalog catalog;
  catalog.add(test::blind_info("bodies-only", Question::kBody));
  catalog.add(test::blind_info("picky", Question::kTriangles, true));
  Scene scene = test::falling_balls(2);
  scene.simulation()->driver = "bodies-only";
  EXPECT_THAT(fault_of(scene, catalog),
              AllOf(StartsWith("scene \"test-balls\", driver bodies-only: "),
                    HasSubstr("neither cells nor triangles")));
  scene.simulation()->driver = "picky";
  EXPECT_EQ(fault_of(scene, catalog),
            "scene \"test-balls\", driver picky: a frame it does not like");
}

TEST(RecordSimulation, ABodyThatIsTooStiffIsNamedWithItsScene) {
  Scene scene = test::falling_balls(2);
  scene.simulation()->materials[1]->stiffness = 1e16;
  EXPECT_THAT(fault_of(scene),
              AllOf(StartsWith("scene \"test-balls\""), HasSubstr("body \"lower\" is too stiff")));
}

TEST(RecordSimulation, DivergenceNamesSceneDriverBodyNodeAndStep) {
  for (double speed : {1e300, std::numeric_limits<double>::quiet_NaN()}) {
    Scene scene = test::falling_balls(2);
    scene.simulation()->velocities[1].y() = speed;
    EXPECT_EQ(fault_of(scene),
              "scene \"test-balls\", driver ffd-aabb-sphere2+tri: the simulation diverged: body "
              "\"lower\", node 0, step 0.");
  }
}

}  // namespace
}  // namespace contactcheck::scene
