#include "reference/judge/accuracy.h"

#include <gmock/gmock.h>

#include <limits>
#include <numeric>

#include "core/detect/registry.h"
#include "reference/adapters/register.h"
#include "tests/support/approach_scene.h"
#include "tests/support/shapes.h"

namespace contactcheck::judge {
namespace {

scene::Scene spheres() {
  const auto ball = test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.5, 2), {3, 3, 3}).shape;
  return test::approach_scene(ball, ball, {{0.0, 1.4}, {1.0, 0.85}, {2.0, 1.4}}, 0.05, 0.03, 12,
                              2.0 / 12.0, {Level::kBody, Level::kCell, Level::kTriangle});
}

struct Judged : results::Run {
  std::vector<Disagreement> disagreements;
};

Judged accuracy_of(const scene::Scene& scene, const std::string& name) {
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  adapters::register_reference_detectors(catalog);
  const auto detector = catalog.make(catalog.parse(name));
  process::SharedProgress page;
  process::ProgressWriter progress(&page);
  const JudgedScene judged = judge_scene(scene, progress);
  Judged result;
  JudgingTools tools(judged);
  result.disagreements = run_accuracy(tools, 0, *detector, progress, result).disagreements;
  return result;
}

TEST(Accuracy, ExactDetectorsAreExact) {
  const scene::Scene scene = spheres();
  std::string hash;
  for (const char* name : {"fcl-aabb", "fcl-obbrss", "ffd-grid+tri", "ffd-aabb+tri",
                           "ffd-aabb-sphere2+tri", "ffd-aabb-sphereN+tri"}) {
    const Judged result = accuracy_of(scene, name);
    EXPECT_GT(result.levels.at(Level::kTriangle).truth, 20u);
    EXPECT_TRUE(result.levels.at(Level::kTriangle).perfect()) << name;
    EXPECT_TRUE(result.levels.at(Level::kBody).perfect()) << name;
    EXPECT_TRUE(result.disagreements.empty()) << name;
    if (hash.empty()) hash = result.contact_hash;
    EXPECT_EQ(result.contact_hash, hash) << name;
  }
}

TEST(Accuracy, CountsFramesAndContactFrames) {
  const Judged result = accuracy_of(spheres(), "fcl-aabb");
  EXPECT_EQ(result.frames, 12u);
  EXPECT_EQ(result.per_frame.level, Level::kTriangle);
  const auto touching = std::count_if(result.per_frame.truth.begin(), result.per_frame.truth.end(),
                                      [](std::uint64_t n) { return n > 0; });
  EXPECT_EQ(result.contact_frames, static_cast<std::size_t>(touching));
  EXPECT_GT(touching, 2);
  EXPECT_LT(touching, 10);
}

TEST(Accuracy, StageLossesOfThePaperAddUpToItsMissed) {
  const scene::Scene scene = spheres();
  for (const char* name : {"ffd-aabb-sphere2", "ffd-grid", "ffd-aabb-sphere2+tri:bounds=paper"}) {
    const Judged result = accuracy_of(scene, name);
    const Level level = result.levels.count(Level::kTriangle) ? Level::kTriangle : Level::kCell;
    std::uint64_t lost = 0;
    for (const results::Stage& s : result.stages) lost += s.missed;
    EXPECT_EQ(lost, result.levels.at(level).missed) << name;
    EXPECT_GE(result.stages.size(), 2u) << name;
  }
}

TEST(Accuracy, RunsOfOneDetectorHaveOneHash) {
  const scene::Scene scene = spheres();
  const Judged first = accuracy_of(scene, "ffd-grid"), again = accuracy_of(scene, "ffd-grid");
  EXPECT_GT(first.levels.at(Level::kCell).reported, 0u);
  EXPECT_EQ(first.contact_hash, again.contact_hash);
  scene::Scene aside = spheres();
  aside.motions[1].path.position[1].keys = {{0.0, 0.4}};
  EXPECT_NE(first.contact_hash, accuracy_of(aside, "ffd-grid").contact_hash);
}

TEST(JudgeScene, StopsAtANonFiniteNodeAndSaysWhere) {
  scene::Scene scene = spheres();
  scene.recorded = test::recorded_frames(scene);
  scene.recorded[4][1][9].y() = std::numeric_limits<double>::quiet_NaN();
  process::SharedProgress page;
  process::ProgressWriter progress(&page);
  const JudgedScene judged = judge_scene(scene, progress);
  EXPECT_EQ(judged.refused, "frame 4, body \"moving\": node 9 is not finite");
  EXPECT_EQ(judged.truth.size(), 4u);
}

TEST(JudgeScene, ComputesOnlyTheTruthThatTheSceneWants) {
  const auto ball = test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.5, 1), {2, 2, 2}).shape;
  const auto shell = test::make_body("", test::sphere_mesh(Vec3::Zero(), 2.0, 1), {2, 2, 2}).shape;
  scene::Scene scene =
      test::approach_scene(shell, ball, {{0.0, 0.0}}, 0, 0, 1, 1.0, {Level::kTriangle});
  process::SharedProgress page;
  process::ProgressWriter progress(&page);
  EXPECT_TRUE(judge_scene(scene, progress).truth.at(0).containment.empty());
  scene.levels = {Level::kContainment};
  EXPECT_EQ(judge_scene(scene, progress).truth.at(0).containment.size(), 1u);
}

}  // namespace
}  // namespace contactcheck::judge
