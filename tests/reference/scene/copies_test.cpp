// "copies" of a body in scene files.
#include <gmock/gmock.h>

#include "reference/scene/scene.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::scene {
namespace {

using test::Scratch;
using test::sentence_of;

std::string scene_with(const std::string& copies, const std::string& more = "") {
  return R"({"id": "s", "frames": 3, "time_step": 1, "levels": ["body"], "bodies": [)" + more +
         R"({"name": "ball", "copies": )" + copies +
         R"(, "mesh": {"shape": "sphere", "divisions": 1, "size": 1}, "lattice": {"kept": 8},
             "motion": {"position": [[0, [5, 0, 0]], [2, [7, 0, 0]]]}}]})";
}

Scene load_copies(const std::string& text) {
  const Scratch scratch;
  return load_scene(scratch.write("s.json", text));
}

Vec3 center_at(const Scene& scene, std::size_t body, double time) {
  const std::vector<Vec3> nodes = nodes_at(*scene.bodies[body].shape, scene.motions[body], time);
  return bounding_box(nodes).center();
}

TEST(Copies, StandInAGridAndShareTheShape) {
  const Scene scene = load_copies(scene_with(R"({"counts": [2, 3, 2], "spacing": [10, 20, 30]})"));
  ASSERT_EQ(scene.bodies.size(), 12u);
  EXPECT_EQ(scene.bodies[0].name, "ball-1");
  EXPECT_EQ(scene.bodies[11].name, "ball-12");
  EXPECT_EQ(scene.bodies[0].shape, scene.bodies[11].shape);
  EXPECT_EQ(scene.origins.size(), 12u);
  EXPECT_LT((center_at(scene, 0, 0.0) - Vec3(5, 0, 0)).norm(), 1e-12);
  EXPECT_LT((center_at(scene, 1, 0.0) - Vec3(15, 0, 0)).norm(), 1e-12);
  EXPECT_LT((center_at(scene, 2, 0.0) - Vec3(5, 20, 0)).norm(), 1e-12);
  EXPECT_LT((center_at(scene, 11, 1.0) - Vec3(16, 40, 30)).norm(), 1e-12);
}

TEST(Copies, MoveLaterAndAreTurned) {
  const Scene scene = load_copies(
      scene_with(R"({"counts": [3, 1, 1], "spacing": [10, 0, 0], "delay": 0.5, "turn": 90})"));
  EXPECT_LT((center_at(scene, 2, 2.0) - Vec3(26, 0, 0)).norm(), 1e-12);
  const auto first_node = [&](std::size_t body) {
    const Vec3 node = nodes_at(*scene.bodies[body].shape, scene.motions[body], 0.0)[0];
    return Vec3(node - center_at(scene, body, 0.0));
  };
  const Vec3 plain = first_node(0), turned = first_node(1);
  EXPECT_LT((turned - Vec3(plain.z(), plain.y(), -plain.x())).norm(), 1e-12);
  EXPECT_TRUE(scene.motions[0].path.spins.size() == 1 && scene.motions[2].path.spins.size() == 1);
}

TEST(Copies, RefuseWhatTheyCannotBe) {
  const auto sentence = [](const std::string& text) {
    return sentence_of([&] { load_copies(text); });
  };
  EXPECT_THAT(sentence(scene_with(R"({"counts": [2, 1], "spacing": [1, 1, 1]})")),
              ::testing::HasSubstr("bodies[0].copies.counts"));
  EXPECT_THAT(sentence(scene_with(R"({"counts": [1000, 1000, 1], "spacing": [1, 1, 1]})")),
              ::testing::HasSubstr("asks for more than 100000 copies"));
  EXPECT_THAT(sentence(scene_with(R"({"counts": [0, 1, 1], "spacing": [1, 1, 1]})")),
              ::testing::HasSubstr("bodies[0].copies.counts[0] is 0"));
  EXPECT_THAT(sentence(scene_with(R"({"counts": [1, 1, 1], "spacing": [1, 1, 1], "gap": 1})")),
              ::testing::HasSubstr("gap is not a known key"));
  EXPECT_THAT(sentence(scene_with(R"({"counts": [2, 1, 1], "spacing": [9, 0, 0]})",
                                  R"({"name": "ball-2", "mesh": {"shape": "box"}},)")),
              ::testing::HasSubstr("such that \"ball-2\" is free"));
  std::string still = scene_with(R"({"counts": [2, 1, 1], "spacing": [9, 0, 0]})");
  still.replace(still.find(R"("motion")"), 8, R"("material")");
  EXPECT_THAT(sentence(still), ::testing::HasSubstr("needs a \"motion\" beside it"));
}

}  // namespace
}  // namespace contactcheck::scene
