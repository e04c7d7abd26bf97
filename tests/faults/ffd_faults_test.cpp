// The bounds of the safe reading, shrunk: the losses are seen, and booked on the stage whose bound
// it was.
#include <gmock/gmock.h>

#include "core/detect/ffd_detector.h"
#include "reference/run/accuracy.h"
#include "tests/support/approach_scene.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

// Spheres that sink only 0.02 m into each other.
Scene shallow() {
  const auto ball = test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.5, 2), {3, 3, 3}).shape;
  return test::approach_scene(ball, ball, {{0.0, 1.1}, {1.0, 0.97}, {2.0, 1.1}}, 0.0, 0.0, 10, 0.2,
                              {Level::kBody, Level::kTriangle});
}

FfdConfig safe_config() {
  FfdConfig config;
  config.bounds = BoundsReading::kSafe;
  config.element = ElementTest::kTriangle;
  config.sphere_levels = 2;
  return config;
}

results::Run accuracy_of(const FfdConfig& config) {
  const Scene scene = shallow();
  FfdDetector detector(config);
  SharedProgress page;
  ProgressWriter progress(&page);
  const JudgedScene judged = judge_scene(scene, progress);
  results::Run result;
  JudgingTools tools(judged);
  run_accuracy(tools, 0, detector, progress, result);
  return result;
}

std::uint64_t lost_by(const results::Run& result, const std::string& stage) {
  std::uint64_t lost = 0;
  for (const results::Stage& s : result.stages)
    if (s.name.rfind(stage, 0) == 0) lost += s.missed;
  return lost;
}

TEST(ShrunkBounds, WholeOnesLoseNothing) {
  const results::Run result = accuracy_of(safe_config());
  EXPECT_GT(result.levels.at(Level::kTriangle).truth, 0u);
  EXPECT_TRUE(result.levels.at(Level::kTriangle).perfect());
  for (const results::Stage& s : result.stages) EXPECT_EQ(s.missed, 0u) << s.name;
}

TEST(ShrunkBounds, SpheresLoseEverythingAndTheirStageIsNamed) {
  FfdConfig config = safe_config();
  config.sphere_radius = 0.5;
  const results::Run result = accuracy_of(config);
  const results::LevelCounts& counts = result.levels.at(Level::kTriangle);
  EXPECT_EQ(counts.missed, counts.truth);
  EXPECT_EQ(counts.spurious, 0u);
  EXPECT_EQ(lost_by(result, "sphere"), counts.missed);
  EXPECT_EQ(result.levels.at(Level::kBody).missed, result.contact_frames);
}

TEST(ShrunkBounds, BoxesOfATenthOfTheirSizeLoseEverything) {
  FfdConfig config = safe_config();
  config.faults.cell_box = 0.1;
  const results::Run result = accuracy_of(config);
  EXPECT_EQ(result.levels.at(Level::kTriangle).missed, result.levels.at(Level::kTriangle).truth);
}

TEST(ShrunkBounds, BoxesLosePairsAndTheHashStageIsNamed) {
  FfdConfig config = safe_config();
  config.faults.cell_box = 0.9;
  const results::Run result = accuracy_of(config);
  const results::LevelCounts& counts = result.levels.at(Level::kTriangle);
  EXPECT_GT(counts.missed, 0u);
  EXPECT_EQ(counts.spurious, 0u);
  EXPECT_EQ(lost_by(result, "hash"), counts.missed);
  EXPECT_EQ(lost_by(result, "sphere"), 0u);
}

TEST(ShrunkBounds, LossesOfAllStagesAddUpToTheMissed) {
  FfdConfig config = safe_config();
  config.sphere_radius = 0.97;
  config.faults.cell_box = 0.97;
  const results::Run result = accuracy_of(config);
  std::uint64_t lost = 0;
  for (const results::Stage& s : result.stages) lost += s.missed;
  EXPECT_GT(lost, 0u);
  EXPECT_EQ(lost, result.levels.at(Level::kTriangle).missed);
}

}  // namespace
}  // namespace contactcheck
