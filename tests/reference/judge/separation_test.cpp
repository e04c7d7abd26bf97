#include <gmock/gmock.h>

#include <cmath>
#include <memory>
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

// Frames of a family are recorded.
scene::Scene as_family(const scene::Scene& moments) {
  scene::Scene out = moments;
  for (std::size_t f = 0; f < moments.frames; ++f)
    out.recorded.push_back(moments.nodes_of_frame(f));
  out.kind = scene::CaseFamily{};
  return out;
}

TEST(Separations, OfCasesAndOfOneBodyAreNone) {
  const scene::Scene family = as_family(approaching_boxes());
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

results::Scene summary_of(const scene::Scene& scene) {
  process::SharedProgress page;
  process::ProgressWriter progress(&page);
  return scene_summary(judge_scene(scene, progress));
}

TEST(SceneScale, IsOfTrianglesAtRestAndOfAllFrames) {
  scene::Scene scene = approaching_boxes();
  const std::optional<results::SceneScale> scale = summary_of(scene).scale;
  ASSERT_TRUE(scale.has_value());
  EXPECT_DOUBLE_EQ(scale->shortest_edge, std::sqrt(0.5))
      << "sides of a half, halved along a diagonal";
  EXPECT_DOUBLE_EQ(scale->longest_edge, std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(scale->reach, 2.0) << "of the second box in the first frame, at 1.5";
  scene = as_family(scene);
  EXPECT_FALSE(summary_of(scene).scale.has_value());
}

TEST(SceneScale, KeepsLengthsWhoseSquaresAreNoDouble) {
  for (const double size : {1e-200, 1e200}) {
    scene::Scene scene = approaching_boxes();
    BodyShape shape = *scene.bodies[0].shape;
    for (Vec3& vertex : shape.mesh.vertices) vertex *= size;
    scene.bodies[0].shape = scene.bodies[1].shape = std::make_shared<const BodyShape>(shape);
    JudgedScene judged;
    judged.scene = &scene;
    const std::optional<results::SceneScale> scale = scene_summary(judged).scale;
    ASSERT_TRUE(scale.has_value());
    EXPECT_DOUBLE_EQ(scale->shortest_edge, size * std::sqrt(0.5));
  }
}

TEST(SceneScale, IsNoneWhereALengthIsNoDouble) {
  scene::Scene scene = approaching_boxes();
  BodyShape shape = *scene.bodies[0].shape;
  for (Vec3& vertex : shape.mesh.vertices) vertex *= 2.0, vertex *= 1.7e308;
  scene.bodies[0].shape = std::make_shared<const BodyShape>(shape);
  JudgedScene judged;
  judged.scene = &scene;
  EXPECT_FALSE(scene_summary(judged).scale.has_value());
}

TEST(SceneScale, HasNoEdgeOfATriangleThatIsAPoint) {
  scene::Scene scene = approaching_boxes();
  BodyShape shape = *scene.bodies[0].shape;
  shape.mesh.triangles.push_back({0, 0, 0});
  scene.bodies[0].shape = std::make_shared<const BodyShape>(shape);
  JudgedScene judged;
  judged.scene = &scene;
  EXPECT_DOUBLE_EQ(scene_summary(judged).scale->shortest_edge, std::sqrt(0.5));
  scene.bodies.resize(1);
  shape.mesh.triangles = {{0, 0, 0}};
  scene.bodies[0].shape = std::make_shared<const BodyShape>(shape);
  EXPECT_FALSE(scene_summary(judged).scale.has_value());
}

}  // namespace
}  // namespace contactcheck::judge
