// The detector bd-tree is exact: brute force over all pairs of triangles finds the same.

#include <gmock/gmock.h>

#include <algorithm>
#include <thread>

#include "core/detect/bd_tree_detector.h"
#include "core/types/check.h"
#include "tests/core/detect/bd_tree_scenes.h"

namespace contactcheck {
namespace {

using test::answer;
using test::bent;
using test::deformed_pair;
using test::FrameData;
using test::prepared;
using test::Scene;
using test::twisted;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct JudgedScene {
  Scene scene;
  std::vector<ContactSet> truth;  // per frame
};

std::vector<JudgedScene> judged(std::vector<Scene> scenes) {
  std::vector<JudgedScene> out;
  for (Scene& scene : scenes) {
    out.push_back({std::move(scene), {}});
    for (const FrameData& frame : out.back().scene.frames) {
      ContactSet truth;
      truth.triangles = true_pairs(out.back().scene, frame);
      truth.canonicalize();
      out.back().truth.push_back(truth);
    }
  }
  return out;
}

// Made once: brute force is the expensive part.
const std::vector<JudgedScene>& judged_scenes() {
  static const std::vector<JudgedScene> scenes =
      judged({deformed_pair(twisted, bent, {3.5, 2.0, 1.2}), deformed_pair(bent, bent, {1.9}),
              test::approach({.seed = 41, .strength = 0.0}, 4), test::approach({.seed = 42}, 4),
              test::approach({.seed = 43, .strength = 1.0}, 3), test::three_bodies({.seed = 44}),
              test::exact_boxes(Vec3::Zero()), test::exact_boxes(Vec3(1 << 20, 3, -5), 0x1p-8)});
  return scenes;
}

TEST(BdTreeScenes, HaveFramesWithAndWithoutContact) {
  int contact = 0, apart = 0;
  for (const JudgedScene& scene : judged_scenes())
    for (const ContactSet& truth : scene.truth) (truth.bodies.empty() ? apart : contact) += 1;
  EXPECT_GT(contact, 8);
  EXPECT_GT(apart, 3);
}

class BdTreeVariants : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(All, BdTreeVariants,
                         ::testing::Values("bd-tree", "bd-tree:leaf=1", "bd-tree:leaf=64",
                                           "bd-tree:reference=rigid", "bd-tree:reference=none",
                                           "bd-tree:bound=paper",
                                           "bd-tree:bound=paper,reference=rigid",
                                           "bd-tree:bound=paper,reference=none"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

TEST_P(BdTreeVariants, EqualBruteForceInBothQuestionsAndAnyOrderOfFrames) {
  for (const JudgedScene& scene : judged_scenes()) {
    const auto detector = prepared(GetParam(), scene.scene);
    const std::size_t frames = scene.truth.size();
    for (std::size_t step = 0; step < 2 * frames; ++step) {
      const std::size_t f = (2 * frames - step) * 2 % frames;
      const ContactSet got = answer(*detector, scene.scene.frames[f], Question::kTriangles);
      EXPECT_EQ(got.triangles, scene.truth[f].triangles) << "frame " << f;
      const ContactSet boolean =
          answer(*detector, scene.scene.frames[step % frames], Question::kBody);
      EXPECT_EQ(boolean.bodies, scene.truth[step % frames].bodies);
      EXPECT_THAT(boolean.triangles, IsEmpty());
    }
  }
}

TEST(BdTree, ClaimsExactTrianglesAndNeedsNoVertices) {
  const JudgedScene& scene = judged_scenes().front();
  const auto detector = prepared("bd-tree", scene.scene);
  EXPECT_THAT(detector->semantics().levels, ElementsAre(Level::kBody, Level::kTriangle));
  EXPECT_THAT(detector->semantics().questions, ElementsAre(Question::kTriangles, Question::kBody));
  EXPECT_TRUE(detector->semantics().exact && detector->semantics().closed);
  EXPECT_FALSE(detector->needs_vertices());
  Frame frame = scene.scene.frames[2].frame();
  for (BodyState& body : frame.bodies) body.vertices = {};
  detector->update(frame);
  ContactSet got;
  detector->query(Question::kTriangles, got);
  got.canonicalize();
  EXPECT_EQ(got.triangles, scene.truth[2].triangles);
  EXPECT_FALSE(got.triangles.empty());
}

TEST(BdTree, SwappedBodiesGiveTheSwappedAnswer) {
  const Scene scene = deformed_pair(twisted, bent, {1.5});
  Scene swapped = scene;
  std::swap(swapped.bodies[0], swapped.bodies[1]);
  std::swap(swapped.frames[0].nodes[0], swapped.frames[0].nodes[1]);
  std::swap(swapped.frames[0].vertices[0], swapped.frames[0].vertices[1]);
  std::vector<ElementPair> back;
  for (const ElementPair& p : answer(*prepared("bd-tree", swapped), swapped.frames[0]).triangles)
    back.push_back({p.body_a, p.body_b, p.b, p.a});
  canonicalize(back);
  EXPECT_EQ(answer(*prepared("bd-tree", scene), scene.frames[0]).triangles, back);
  EXPECT_FALSE(back.empty());
}

TEST(BdTree, InstancesShareAModelAndNoState) {
  Scene scene = deformed_pair(twisted, twisted, {1.9});
  scene.bodies.push_back({"third", scene.bodies[0].shape});
  std::vector<std::vector<Vec3>> nodes = scene.frames[0].nodes;
  nodes.push_back(nodes[1]);
  for (Vec3& n : nodes[2]) n += Vec3(1.9, 0, 0);
  scene.frames = {test::make_frame(scene.bodies, nodes)};
  const auto models = make_bd_models(scene.bodies, 4);
  EXPECT_TRUE(models[0] == models[1] && models[1] == models[2]);
  const ContactSet got = answer(*prepared("bd-tree", scene), scene.frames[0]);
  EXPECT_EQ(got.triangles, true_pairs(scene, scene.frames[0]));
  EXPECT_THAT(got.bodies, ElementsAre(BodyPair{0, 1}, BodyPair{1, 2}));
}

TEST(BdTree, TwoOnTwoThreadsDoNotMeet) {
  const Scene scene = deformed_pair(twisted, bent, {2.0, 1.2, 3.0});
  const auto run = [&](std::vector<ContactSet>& out) {
    const auto detector = prepared("bd-tree", scene);
    for (int round = 0; round < 3; ++round)
      for (const FrameData& frame : scene.frames) out.push_back(answer(*detector, frame));
  };
  std::vector<ContactSet> alone, left, right;
  run(alone);
  std::thread other([&] { run(left); });
  run(right);
  other.join();
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(left[i].triangles, alone[i].triangles);
    EXPECT_EQ(right[i].triangles, alone[i].triangles);
  }
}

TEST(BdTree, SmallScenesHaveNoContact) {
  Scene none, one = deformed_pair(bent, bent, {2.0}, 1);
  none.frames.emplace_back();
  one.bodies.resize(1);
  one.frames = {test::make_frame(one.bodies, {one.frames[0].nodes[0]})};
  for (const Scene* scene : {&none, &one}) {
    const ContactSet got = answer(*prepared("bd-tree", *scene), scene->frames[0]);
    EXPECT_TRUE(got.bodies.empty() && got.triangles.empty());
  }
}

TEST(BdTree, RefusesABodyWithoutALatticeByName) {
  Scene scene = deformed_pair(bent, bent, {2.0}, 1);
  scene.bodies[1] = {"the statue", make_bare_shape(test::unit_box_mesh(1))};
  try {
    prepared("bd-tree", scene);
    FAIL() << "took a body without a lattice";
  } catch (const RefusedInput& e) {
    EXPECT_STREQ(e.what(), "body \"the statue\": the BD-tree needs a lattice for every body");
  }
}

TEST(BdTreeDeathTest, FramesAndQuestionsMustFit) {
  const Scene scene = deformed_pair(bent, bent, {2.0}, 1);
  const auto detector = prepared("bd-tree", scene);
  Frame missing_body = scene.frames[0].frame(), missing_node = missing_body;
  missing_body.bodies.pop_back();
  missing_node.bodies[0].nodes = missing_node.bodies[0].nodes.first(3);
  EXPECT_DEATH(detector->update(missing_body), "one state per prepared body");
  EXPECT_DEATH(detector->update(missing_node), "one position per node");
  EXPECT_DEATH(answer(*detector, scene.frames[0], Question::kCells), "only claimed questions");
}

// What a seeded fault does to it.

TEST(BdTreeFaults, SmallerSpheresLoseATouchAndAreReported) {
  // Mirror images about the corner in which they touch.
  Scene scene;
  scene.bodies = {
      test::make_body("left", test::triangle_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), {1, 1, 1}, 0.5),
      test::make_body("right", test::triangle_mesh({2, 0, 0}, {1, 0, 0}, {2, -1, 0}), {1, 1, 1},
                      0.5)};
  scene.frames = {
      test::make_frame(scene.bodies, {test::rest_nodes_at(*scene.bodies[0].shape, Vec3::Zero()),
                                      test::rest_nodes_at(*scene.bodies[1].shape, Vec3::Zero())})};
  const std::vector<ElementPair> truth = {{0, 1, 0, 0}};
  ASSERT_EQ(true_pairs(scene, scene.frames[0]), truth);
  for (double fault : {1.0, 0.95}) {
    BdSettings settings;
    settings.fault_radius = fault;
    BdTreeDetector detector(settings);
    detector.prepare(scene.bodies);
    const ContactSet got = answer(detector, scene.frames[0]);
    EXPECT_EQ(got.triangles, fault == 1.0 ? truth : std::vector<ElementPair>{});
    const Frame frame = scene.frames[0].frame();
    detector.update(frame);
    EXPECT_EQ(detector.trees()[0].validate().substr(0, 39),
              fault == 1.0 ? "" : "the sphere of node 0 does not hold vert");
  }
}

TEST(BdTreeFaults, SmallerSpheresMissPairsOfDeformedBodies) {
  const Scene scene = deformed_pair(twisted, bent, {1.5});
  const std::vector<ElementPair> truth = true_pairs(scene, scene.frames[0]);
  BdSettings settings;
  settings.fault_radius = 0.6;
  BdTreeDetector detector(settings);
  detector.prepare(scene.bodies);
  const std::vector<ElementPair> got = answer(detector, scene.frames[0]).triangles;
  EXPECT_LT(got.size(), truth.size());
  EXPECT_TRUE(std::includes(truth.begin(), truth.end(), got.begin(), got.end()));
}

}  // namespace
}  // namespace contactcheck
