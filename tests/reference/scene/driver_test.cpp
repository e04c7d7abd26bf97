// What the driver decides: who may drive, what it is asked, and where the bodies go.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference/scene/driven_simulation.h"
#include "reference/scene/simulate_scene.h"
#include "tests/reference/scene/ball_scenes.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::scene {
namespace {

using ::testing::HasSubstr;

SimulatedMotion driven(const Scene& scene, Detector& driver) {
  return simulate(scene, driver, [](std::size_t) {});
}

SimulatedMotion driven(const Scene& scene, const std::string& name) {
  const std::unique_ptr<Detector> driver = test::core_detector(name);
  return driven(scene, *driver);
}

// Height of the first body's nodes above the second's, on average.
double height_at(const SimulatedMotion& motion, std::size_t frame) {
  const auto& bodies = motion.frames[frame];
  return (test::mean(bodies[0]) - test::mean(bodies[1])).y();
}

double last_height(const SimulatedMotion& motion) {
  return height_at(motion, motion.frames.size() - 1);
}

TEST(WhyNoDriver, OnlyCellsAndTrianglesCanBeRespondedTo) {
  Semantics semantics;
  for (Question question : {Question::kTriangles, Question::kCells}) {
    semantics.questions = {Question::kBody, question};
    EXPECT_EQ(why_no_driver(semantics), "");
  }
  for (Question question : {Question::kBody, Question::kContacts}) {
    semantics.questions = {question};
    EXPECT_THAT(why_no_driver(semantics), HasSubstr("neither cells nor triangles"));
  }
}

TEST(Driver, ThatAnswersBodiesOnlyIsRefused) {
  const Scene scene = test::falling_balls(2);
  test::BlindDetector driver(Question::kBody);
  EXPECT_THAT(test::sentence_of([&] { driven(scene, driver); }),
              HasSubstr("neither cells nor triangles"));
  EXPECT_TRUE(driver.frames().empty());
}

TEST(Driver, IsAskedForTheCellsWhenItHasNoTriangles) {
  test::BlindDetector driver(Question::kCells);
  driven(test::falling_balls(3), driver);
  EXPECT_EQ(driver.asked(), std::vector<Question>(3, Question::kCells));
}

TEST(Driver, BlindOneLetsTheBallsPassThroughEachOther) {
  test::BlindDetector blind(Question::kTriangles);
  const SimulatedMotion motion = driven(test::falling_balls(), blind);
  EXPECT_NEAR(last_height(motion), 0.25 - 1.0 * 0.5, 1e-9);
  for (const std::vector<BodyPair>& pairs : motion.reported) EXPECT_TRUE(pairs.empty());
}

class SeeingDriver : public ::testing::TestWithParam<const char*> {};

TEST_P(SeeingDriver, KeepsTheBallsApart) {
  const SimulatedMotion motion = driven(test::falling_balls(), GetParam());
  EXPECT_GT(last_height(motion), test::kBallRadius);
  EXPECT_THAT(motion.reported, ::testing::Contains(std::vector<BodyPair>{{0, 1}}));
}

INSTANTIATE_TEST_SUITE_P(Core, SeeingDriver,
                         ::testing::Values("ffd-grid", "ffd-aabb-sphere2", "ffd-aabb-sphere2+tri"));

// Cells reach beyond the mesh that they hold: who answers with cells holds bodies farther apart.
TEST(Driver, ThatTestsCellsKeepsTheBallFartherFromTheSlab) {
  const Scene scene = test::ball_on_slab(60);  // 1 s
  const SimulatedMotion cells = driven(scene, "ffd-grid");
  const SimulatedMotion triangles = driven(scene, "ffd-aabb-sphere2+tri");
  // Both lie on it; they may roll on their facets, so that height alone is compared. In the sixth
  // of a second since frame 49 a free fall would be 136 mm.
  for (const SimulatedMotion* motion : {&cells, &triangles})
    EXPECT_NEAR(last_height(*motion), height_at(*motion, 49), 0.004);
  // The lattices reach 2 % of the sides beyond the meshes: 4 mm of the ball and 2 mm of the slab.
  EXPECT_GT(last_height(cells), last_height(triangles) + 0.004);
  EXPECT_TRUE(test::same_bits({{scene.nodes_at(0.0)[1]}}, {{cells.frames.back()[1]}}));
}

// The four parts are the step, and what the detector saw is the state before the response.
TEST(DrivenSimulation, StepIsItsFourPartsInOrder) {
  const Scene scene = test::falling_balls();
  const std::unique_ptr<Detector> one = test::core_detector("ffd-aabb-sphere2+tri");
  const std::unique_ptr<Detector> other = test::core_detector("ffd-aabb-sphere2+tri");
  DrivenSimulation whole(scene, *one), parts(scene, *other);
  bool corrected = false;
  for (std::size_t step = 0; step < scene.frames; ++step) {
    whole.step();
    parts.deform();
    parts.update_cells();
    EXPECT_EQ(parts.nodes()[0], parts.simulation().state().bodies[0].positions);
    parts.test();
    parts.respond();
    EXPECT_EQ(parts.contacts().triangles, whole.contacts().triangles);
    EXPECT_TRUE(test::same_bits({parts.nodes()}, {whole.nodes()}));
    corrected = corrected || parts.nodes()[0] != parts.simulation().state().bodies[0].positions;
    EXPECT_EQ(parts.simulation().state().bodies[0].positions,
              whole.simulation().state().bodies[0].positions);
  }
  EXPECT_TRUE(corrected);
}

}  // namespace
}  // namespace contactcheck::scene
