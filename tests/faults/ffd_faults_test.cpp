// The bounds of the safe reading shrunk, and those of the paper: what they miss is seen, and
// counted for the stage whose bound it was.
#include <gmock/gmock.h>

#include "core/detect/ffd_detector.h"
#include "reference/judge/accuracy.h"
#include "tests/support/approach_scene.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

// Spheres that sink only 0.02 m into each other.
scene::Scene shallow() {
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

// A small ball that touches the middle of a large cell.
scene::Scene small_on_large() {
  const auto ball = test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.5, 2), {1, 1, 1}).shape;
  const auto small = test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.1, 2), {1, 1, 1}).shape;
  return test::approach_scene(ball, small, {{0.0, 0.7}, {1.0, 0.57}, {2.0, 0.7}}, 0.0, 0.0, 10, 0.2,
                              {Level::kBody, Level::kTriangle});
}

results::Run accuracy_of(const FfdConfig& config, const scene::Scene& scene = shallow()) {
  FfdDetector detector(config);
  process::SharedProgress page;
  process::ProgressWriter progress(&page);
  const judge::JudgedScene judged = judge::judge_scene(scene, progress);
  results::Run result;
  judge::JudgingTools tools(judged);
  judge::run_accuracy(tools, 0, detector, progress, result);
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

// The paper hashes a box into the buckets of its corners alone.
TEST(PaperBounds, BoxesWiderThanABucketMissPairsAndTheHashStageIsNamed) {
  FfdConfig config = safe_config();
  config.bounds = BoundsReading::kPaper;
  config.sphere_levels = 0;
  config.hash_cell = 0.2;
  config.table_size = 1 << 16;  // few share a bucket by chance
  const results::Run result = accuracy_of(config, small_on_large());
  const results::LevelCounts& counts = result.levels.at(Level::kTriangle);
  EXPECT_GT(counts.missed, 0u);
  EXPECT_EQ(counts.spurious, 0u);
  EXPECT_EQ(lost_by(result, "hash"), counts.missed);
}

TEST(ShrunkBounds, LossesOfAllStagesAddUpToTheMissed) {
  FfdConfig config = safe_config();
  config.sphere_radius = 0.6;
  const results::Run result = accuracy_of(config);
  std::uint64_t lost = 0;
  for (const results::Stage& s : result.stages) lost += s.missed;
  EXPECT_GT(lost, 0u);
  EXPECT_EQ(lost, result.levels.at(Level::kTriangle).missed);
}

}  // namespace
}  // namespace contactcheck
