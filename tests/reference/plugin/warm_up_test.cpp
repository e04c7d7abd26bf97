#include "reference/plugin/warm_up.h"

#include <gtest/gtest.h>

#include "reference/oracle/oracle.h"

namespace contactcheck::plugin {
namespace {

TEST(WarmUpScene, IsInContactInSomePosesAndInOthersNot) {
  const WarmUpScene scene;
  ASSERT_EQ(scene.bodies().size(), 2u);
  oracle::Oracle oracle(scene.bodies());
  std::size_t contacts = 0;
  for (std::size_t i = 0; i < WarmUpScene::kPoses; ++i) {
    const Frame frame = scene.frame(i);
    const oracle::Truth truth = oracle.judge(frame, oracle::WantedTruth{});
    contacts += truth.surface.bodies.size();
    if (i == WarmUpScene::kPoses / 2) {
      EXPECT_GT(truth.surface.triangles.size(), 50u);
    }
  }
  EXPECT_GT(contacts, WarmUpScene::kPoses / 4);
  EXPECT_LT(contacts, WarmUpScene::kPoses * 3 / 4);
}

TEST(WarmUpScene, HasPosesThatDifferAndGoRound) {
  const WarmUpScene scene;
  for (std::size_t i = 0; i < WarmUpScene::kPoses; ++i) {
    const Step step = scene.step(i);
    EXPECT_NE(step.start.bodies[1].vertices[0], step.end.bodies[1].vertices[0]) << i;
    EXPECT_NE(step.start.bodies[0].nodes[0], step.end.bodies[0].nodes[0]) << i;
    EXPECT_LT(step.start.time, step.end.time) << i;
  }
  EXPECT_EQ(scene.frame(WarmUpScene::kPoses).bodies[0].nodes.data(),
            scene.frame(0).bodies[0].nodes.data());
}

}  // namespace
}  // namespace contactcheck::plugin
