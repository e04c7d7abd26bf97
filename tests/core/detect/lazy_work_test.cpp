// What laziness saves, by counters and bytes, not by time.

#include <gmock/gmock.h>

#include "core/detect/lazy_detector.h"
#include "tests/core/detect/scenes.h"

namespace contactcheck {
namespace {

using test::answer;
using test::make_frame;
using test::rest_nodes_at;
using test::Scene;
using ::testing::IsEmpty;

std::unique_ptr<LazyDetector> prepared(const LazyConfig& config, const Scene& scene) {
  auto detector = std::make_unique<LazyDetector>(config);
  detector->prepare(scene.bodies);
  return detector;
}

// Two balls of 32768 triangles, the second at `at`.
Scene large_balls(const Vec3& at) {
  static const Body ball =
      test::make_body("ball", test::sphere_mesh(Vec3::Zero(), 1.0, 6), {5, 5, 5});
  Scene scene;
  scene.bodies = {ball, ball};
  scene.frames = {make_frame(
      scene.bodies, {rest_nodes_at(*ball.shape, Vec3::Zero()), rest_nodes_at(*ball.shape, at)})};
  return scene;
}

std::size_t leaves_of(const Scene& scene) {
  std::size_t leaves = 0;
  for (const Body& body : scene.bodies) leaves += make_lattice_tree(*body.shape).leaves.size();
  return leaves;
}

TEST(LazyWork, BoundsNothingOfBodiesFarApart) {
  const Scene scene = large_balls(Vec3(5, 0, 0));
  for (BoundSource bounds : {BoundSource::kNodes, BoundSource::kCheaper}) {
    const auto detector = prepared({bounds}, scene);
    EXPECT_THAT(answer(*detector, scene.frames[0], Question::kTriangles).triangles, IsEmpty());
    EXPECT_EQ(detector->counters().blocks_bounded, 0u);
    EXPECT_EQ(detector->counters().block_pairs, 0u);
    EXPECT_EQ(detector->counters().leaves_mapped, 0u);
    EXPECT_EQ(detector->counters().vertices_mapped, 0u);
  }
}

// Fewer triangles than a lattice of this many cells is worth: `auto` maps and refits.
TEST(LazyWork, RefitsSmallMeshesOnlyWhereBodiesMeet) {
  const Body ball = test::make_body("ball", test::sphere_mesh(Vec3::Zero(), 1.0, 3), {6, 6, 6});
  Scene scene;
  scene.bodies = {ball, ball, ball};
  const auto at = [&](double x) { return rest_nodes_at(*ball.shape, Vec3(x, 0, 0)); };
  scene.frames = {make_frame(scene.bodies, {at(0), at(1.9), at(9)})};
  const std::size_t blocks = make_lattice_tree(*ball.shape, TreeUse::kVertices).blocks.size();
  const auto detector = prepared({BoundSource::kCheaper}, scene);
  ContactSet truth;
  truth.triangles = test::true_pairs(scene, scene.frames[0]);
  ASSERT_FALSE(truth.triangles.empty());
  EXPECT_EQ(answer(*detector, scene.frames[0], Question::kTriangles).triangles, truth.triangles);
  EXPECT_EQ(detector->counters().blocks_bounded, 2 * blocks);
  EXPECT_EQ(detector->validate(scene.frames[0].vertices), "");
  const auto full = prepared({BoundSource::kVertices}, scene);
  answer(*full, scene.frames[0], Question::kTriangles);
  EXPECT_EQ(full->counters().blocks_bounded, 3 * blocks);
}

TEST(LazyWork, MapsHardlyALeafInANearMiss) {
  const Vec3 direction = Vec3(1.0, 0.7, 0.4).normalized();
  const Scene scene = large_balls(2.02 * direction);
  const auto detector = prepared({BoundSource::kNodes}, scene);
  EXPECT_THAT(answer(*detector, scene.frames[0], Question::kTriangles).triangles, IsEmpty());
  EXPECT_GT(detector->counters().block_pairs, 0u);  // the bodies' boxes overlap
  EXPECT_LT(20 * detector->counters().leaves_mapped, leaves_of(scene));
  EXPECT_LT(4 * detector->counters().blocks_bounded,
            2 * make_lattice_tree(*scene.bodies[0].shape).blocks.size());
}

TEST(LazyWork, MapsUnderATenthOfTheLeavesInAShallowContact) {
  const Scene scene = large_balls(1.99 * Vec3(1.0, 0.7, 0.4).normalized());
  const auto detector = prepared({BoundSource::kNodes}, scene);
  const ContactSet got = answer(*detector, scene.frames[0], Question::kTriangles);
  EXPECT_GT(got.triangles.size(), 50u);
  EXPECT_GT(detector->counters().leaves_mapped, 0u);
  EXPECT_LT(10 * detector->counters().leaves_mapped, leaves_of(scene));
  EXPECT_LT(100 * detector->counters().filter_failures, detector->counters().triangle_tests);
  const auto refit = prepared({BoundSource::kVertices}, scene);
  EXPECT_EQ(answer(*refit, scene.frames[0], Question::kTriangles).triangles, got.triangles);
}

TEST(LazyWork, MapsALeafOnceHoweverManyPairsNeedIt) {
  const Scene scene = large_balls(1.99 * Vec3(1.0, 0.7, 0.4).normalized());
  const auto detector = prepared({BoundSource::kNodes}, scene);
  const Frame frame = scene.frames[0].frame();
  detector->update(frame);
  ContactSet out;
  detector->query(Question::kTriangles, out);
  const LazyCounters once = detector->counters();
  detector->query(Question::kTriangles, out);
  EXPECT_EQ(detector->counters().leaves_mapped, once.leaves_mapped);
  EXPECT_EQ(detector->counters().blocks_bounded, once.blocks_bounded);
  EXPECT_EQ(detector->counters().triangle_tests, 2 * once.triangle_tests);
  detector->update(frame);
  EXPECT_EQ(detector->counters().leaves_mapped, 0u);
}

TEST(LazyWork, TestsLessForABooleanThanForAllTriangles) {
  const Scene scene = large_balls(Vec3(1.3, 0.2, 0.1));
  const auto detector = prepared({BoundSource::kNodes}, scene);
  answer(*detector, scene.frames[0], Question::kTriangles);
  const LazyCounters all = detector->counters();
  EXPECT_EQ(answer(*detector, scene.frames[0], Question::kBody).bodies.size(), 1u);
  EXPECT_LT(2 * detector->counters().leaves_mapped, all.leaves_mapped);
  EXPECT_LT(2 * detector->counters().triangle_tests, all.triangle_tests);
}

TEST(LazyWork, SharesTheTreeOfInstances) {
  const Body ball = test::make_body("ball", test::sphere_mesh(Vec3::Zero(), 1.0, 3), {4, 4, 4});
  const Body copy = test::make_body("copy", test::sphere_mesh(Vec3::Zero(), 1.0, 3), {4, 4, 4});
  const auto bytes = [](const std::vector<Body>& bodies) {
    LazyDetector detector({});
    detector.prepare(bodies);
    return detector.shared_bytes();
  };
  EXPECT_EQ(bytes({ball}), make_lattice_tree(*ball.shape, TreeUse::kVertices).bytes());
  EXPECT_EQ(bytes({ball, ball, ball}), bytes({ball}));
  EXPECT_EQ(bytes({ball, copy, ball}), 2 * bytes({ball}));
  EXPECT_EQ(bytes({}), 0u);
}

TEST(LazyWork, HoldsLittlePerInstanceInANearMissAndNoMoreInLaterFrames) {
  const Scene scene = large_balls(2.02 * Vec3(1.0, 0.7, 0.4).normalized());
  const auto detector = prepared({BoundSource::kNodes}, scene);
  answer(*detector, scene.frames[0], Question::kTriangles);
  const std::size_t once = detector->instance_bytes();
  EXPECT_GT(once, 0u);
  EXPECT_LT(static_cast<double>(once) / (2.0 * 32768), 5.0);
  for (int round = 0; round < 3; ++round) answer(*detector, scene.frames[0], Question::kTriangles);
  EXPECT_EQ(detector->instance_bytes(), once);
}

}  // namespace
}  // namespace contactcheck
