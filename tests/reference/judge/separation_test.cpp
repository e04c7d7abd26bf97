#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/judge/accuracy.h"
#include "reference/judge/judged_scene.h"
#include "reference/judge/scene_summary.h"
#include "tests/support/approach_scene.h"
#include "tests/support/shapes.h"

namespace contactcheck::judge {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

// Two boxes of side 1; the second's centre goes from 1.5 to 0.75 in steps of 0.25.
scene::Scene approaching_boxes() {
  const auto box =
      test::make_body("", test::box_mesh(Vec3::Constant(-0.5), Vec3::Constant(0.5), 2), {2, 2, 2})
          .shape;
  return test::approach_scene(box, box, {{0.0, 1.5}, {3.0, 0.75}}, 0.0625, 0.0625, 4, 1.0,
                              {Level::kTriangle});
}

std::vector<double> separations_of(const scene::Scene& scene) {
  process::SharedProgress page;
  process::ProgressWriter progress(&page);
  return separations(judge_scene(scene, progress), progress);
}

TEST(Separations, AreTheGapsAndZeroInContactFrames) {
  const double close = 1e-8;
  EXPECT_THAT(separations_of(approaching_boxes()),
              ElementsAre(DoubleNear(0.5, close), DoubleNear(0.25, close), 0.0, 0.0));
}

TEST(Separations, OfCasesAndOfOneBodyAreNone) {
  scene::Scene family = approaching_boxes();
  family.family.emplace();
  EXPECT_TRUE(separations_of(family).empty());
  scene::Scene alone = approaching_boxes();
  alone.bodies.pop_back();
  alone.motions.pop_back();
  alone.origins.pop_back();
  EXPECT_TRUE(separations_of(alone).empty());
}

TEST(Separations, StandInTheSummaryWhereThereAreAny) {
  const scene::Scene scene = approaching_boxes();
  process::SharedProgress page;
  process::ProgressWriter progress(&page);
  const JudgedScene judged = judge_scene(scene, progress);
  EXPECT_EQ(scene_summary(judged, {0.5, 0.0}).separation.size(), 2u);
  EXPECT_TRUE(scene_summary(judged, {}).separation.empty());
}

}  // namespace
}  // namespace contactcheck::judge
