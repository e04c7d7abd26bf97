// The touch of two corners is found, with nothing to spare: bounds that are 1 % smaller miss it.
// (Mutants: cell-box-smaller, buckets-fewer.)

#include <gtest/gtest.h>

#include "core/detect/ffd_detector.h"
#include "tests/core/detect/scenes.h"

namespace contactcheck {
namespace {

using test::Scene;

// Two triangles, mirror images about the corner in which they touch: that corner is the extreme
// point of both their boxes and both their spheres. All numbers are short binary fractions.
Scene touching_corners() {
  Scene scene;
  scene.bodies = {
      test::make_body("left", test::triangle_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), {1, 1, 1}, 0.5),
      test::make_body("right", test::triangle_mesh({2, 0, 0}, {1, 0, 0}, {2, -1, 0}), {1, 1, 1},
                      0.5)};
  // x = 1 goes to 171/128: just above a line of the hash grid, whose cell is 2/3.
  const Vec3 shift(0.3359375, 0, 0);
  scene.frames.push_back(
      test::make_frame(scene.bodies, {test::rest_nodes_at(*scene.bodies[0].shape, shift),
                                      test::rest_nodes_at(*scene.bodies[1].shape, shift)}));
  return scene;
}

FfdConfig config_with(int sphere_levels) {
  FfdConfig config;
  config.sphere_levels = sphere_levels;
  config.element = ElementTest::kTriangle;
  config.bounds = BoundsReading::kSafe;
  return config;
}

std::vector<ElementPair> found(const FfdConfig& config) {
  const Scene scene = touching_corners();
  FfdDetector detector(config);
  detector.prepare(scene.bodies);
  return test::answer(detector, scene.frames[0]).triangles;
}

// validate()'s sentence for the first body.
std::string promise(const FfdConfig& config) {
  const Scene scene = touching_corners();
  FfdDetector detector(config);
  detector.prepare(scene.bodies);
  const Frame frame = scene.frames[0].frame();
  detector.update(frame);
  return validate(detector.models()[0], detector.states()[0], scene.frames[0].vertices[0]);
}

TEST(SphereRadius, AsNeededFindsTheTouch) {
  const Scene scene = touching_corners();
  const std::vector<ElementPair> truth = {{0, 1, 0, 0}};
  EXPECT_EQ(test::true_pairs(scene, scene.frames[0]), truth);
  for (int levels : {0, 1, 2, 3}) {
    EXPECT_EQ(found(config_with(levels)), truth) << levels;
    EXPECT_EQ(promise(config_with(levels)), "") << levels;
  }
}

TEST(SphereRadius, SmallerSpheresMissTheTouchAndAreReported) {
  for (int levels : {1, 2, 3}) {
    FfdConfig config = config_with(levels);
    config.sphere_radius = 0.99;
    EXPECT_TRUE(found(config).empty()) << levels;
    EXPECT_EQ(promise(config), "triangle 0 leaves its sphere of level 1");
    EXPECT_FALSE(FfdDetector(config).semantics().exact) << "it may miss, and does not deny it";
  }
}

TEST(SphereRadius, LargerSpheresFindTheTouchAndKeepThePromise) {
  for (int levels : {1, 2, 3}) {
    FfdConfig config = config_with(levels);
    config.sphere_radius = 1.5;
    EXPECT_EQ(found(config).size(), 1u) << levels;
    EXPECT_EQ(promise(config), "");
    EXPECT_TRUE(FfdDetector(config).semantics().exact);
  }
}

}  // namespace
}  // namespace contactcheck
