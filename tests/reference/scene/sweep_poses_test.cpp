// Poses at given separations: the oracle's distance is what the scene says.
#include "reference/scene/sweep_poses.h"

#include <gmock/gmock.h>

#include <set>

#include "reference/oracle/oracle.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::scene {
namespace {

using test::sentence_of;
using testing::HasSubstr;

const std::string kSweep =
    R"("sweep": {"separations": [-0.05, 0, 0.001, 0.1, 0.5], "orientations": 6, "seed": 3})";
const std::string kBodies = R"("bodies": [
    {"name": "still", "mesh": {"shape": "torus", "divisions": 8, "size": 2, "center": [5, 0, -1]},
     "lattice": {"cells": [3, 2, 3]}},
    {"name": "coming", "mesh": {"shape": "box", "sides": [1, 0.5, 0.25]}}])";

class SweepPoses : public testing::Test {
 protected:
  Scene load(const std::string& sweep = kSweep, const std::string& bodies = kBodies) const {
    return load_scene(scratch_.write(
        "s.json", R"({"id": "s", "levels": ["triangle"], )" + sweep + ", " + bodies + "}"));
  }
  Scene placed(const std::string& sweep = kSweep, const std::string& bodies = kBodies) const {
    Scene scene = load(sweep, bodies);
    place_sweep([](std::size_t) {}, scene);
    return scene;
  }
  static oracle::DistanceInterval distance(const Scene& scene,
                                           std::vector<std::vector<Vec3>> nodes) {
    std::vector<std::vector<Vec3>> vertices;
    for (std::size_t b = 0; b < nodes.size(); ++b) {
      vertices.emplace_back(scene.bodies[b].shape->mesh.vertices.size());
      map_body(*scene.bodies[b].shape, nodes[b], vertices[b]);
    }
    Frame frame;
    for (std::size_t b = 0; b < nodes.size(); ++b) frame.bodies.push_back({nodes[b], vertices[b]});
    return oracle::Oracle(scene.bodies).distance(frame, {0, 1});
  }

  const test::Scratch scratch_;
};

TEST_F(SweepPoses, StandAtTheDistancesThatTheSceneSays) {
  const Scene scene = placed();
  ASSERT_EQ(scene.frames, 30u);
  ASSERT_EQ(scene.recorded.size(), 30u);
  EXPECT_FALSE(scene.scripted());
  EXPECT_FALSE(scene.follows_time());
  const double tolerance = kSweepTolerance * 2.0;  // the ring is the larger one
  for (std::size_t s = 1; s < 5; ++s)
    for (std::size_t o = 0; o < 6; ++o) {
      const double wanted = 2.0 * scene.sweep()->separations[s];
      const oracle::DistanceInterval is = distance(scene, scene.nodes_of_frame(s * 6 + o));
      EXPECT_GE(is.upper, wanted - 0.5 * tolerance) << s << " " << o;
      EXPECT_LE(is.upper, wanted + tolerance) << s << " " << o;
    }
}

// Back along the way by the depth, the surfaces only just touch; a little farther, they do not.
TEST_F(SweepPoses, BelowZeroGoDeeperByThatMuchThanTheFirstTouch) {
  const Scene scene = placed();
  for (std::size_t o = 0; o < 6; ++o) {
    auto deep = scene.nodes_of_frame(o);
    const auto touch = scene.nodes_of_frame(6 + o), far = scene.nodes_of_frame(24 + o);
    const Vec3 back = touch[1][0] - deep[1][0];
    EXPECT_NEAR(back.norm(), 0.05 * 2.0, 1e-9);
    EXPECT_NEAR(back.normalized().dot((far[1][0] - touch[1][0]).normalized()), 1.0, 1e-6);
    EXPECT_EQ(distance(scene, deep).upper, 0.0) << "these bodies are thick enough to meet there";
  }
}

TEST_F(SweepPoses, KeepTheFirstBodyAndTurnTheSecondEachTimeAnew) {
  const Scene scene = placed();
  std::set<double> edges;
  for (std::size_t f = 0; f < scene.frames; ++f) {
    const auto nodes = scene.nodes_of_frame(f);
    EXPECT_EQ(nodes[0], scene.bodies[0].shape->lattice->rest_nodes());
    const auto& rest = scene.bodies[1].shape->mesh.vertices;
    EXPECT_NEAR((nodes[1][0] - nodes[1][1]).norm(), (rest[0] - rest[1]).norm(), 1e-12);
    if (f < 6) edges.insert((nodes[1][0] - nodes[1][1]).x());
  }
  EXPECT_EQ(edges.size(), 6u);
}

TEST_F(SweepPoses, FollowFromTheSeed) {
  const std::string other =
      R"("sweep": {"separations": [-0.05, 0, 0.001, 0.1, 0.5], "orientations": 6, "seed": 4})";
  EXPECT_EQ(placed().recorded, placed().recorded);
  EXPECT_NE(placed().recorded, placed(other).recorded);
}

struct Wrong {
  std::string sweep, bodies, sentence;
};

TEST_F(SweepPoses, BadSweepsAreRefused) {
  const auto sweep = [](const std::string& inner) { return "\"sweep\": {" + inner + "}"; };
  const std::string good = sweep(R"("separations": [0.1])");
  const std::vector<Wrong> wrong = {
      {sweep(""), kBodies, "sweep.separations is missing."},
      {sweep(R"("separations": [])"), kBodies, "must be an array of at least 1"},
      {sweep(R"("separations": [0.1, 0.1])"), kBodies,
       "sweep.separations[1] is 0.1; it must be above 0.1, the one before."},
      {sweep(R"("separations": [-0.6])"), kBodies, "sweep.separations[0] is -0.6; it must be"},
      {sweep(R"("separations": [0.1], "orientations": 0)"), kBodies,
       "sweep.orientations is 0; it must be a whole number from 1"},
      {sweep(R"("separations": [0.1], "seeds": 0)"), kBodies, "sweep.seeds is not a known key"},
      {good + R"(, "frames": 5)", kBodies, "frames is not allowed beside \"sweep\""},
      {good + R"(, "duration": 5)", kBodies, "duration is not allowed beside \"sweep\""},
      {good, R"("bodies": [{"name": "a", "mesh": {"shape": "box"}}])",
       "bodies is an array of 1; it must be an array of two"},
      {good,
       R"("bodies": [{"name": "a", "mesh": {"shape": "box"}},
                     {"name": "b", "mesh": {"shape": "box"}, "motion": {"position": [0, 0, 0]}}])",
       "bodies[1].motion is not allowed in a sweep"},
  };
  for (const Wrong& w : wrong)
    EXPECT_THAT(sentence_of([&] { load(w.sweep, w.bodies); }), HasSubstr(w.sentence)) << w.sweep;
  const auto file = scratch_.write(
      "t.json", R"({"id": "s", "levels": ["triangle"], )" + good + ", " + kBodies + "}");
  EXPECT_THAT(sentence_of([&] { load_scene(file, 4); }), HasSubstr("is a sweep"));
}

// The line of the centres goes through the ring's hole whatever the turn: a ball half as wide.
TEST_F(SweepPoses, WaysThatMissAreDrawnAgain) {
  const Scene scene = placed(R"("sweep": {"separations": [0.01], "orientations": 40, "seed": 1})",
                             R"("bodies": [
    {"name": "ring", "mesh": {"shape": "torus", "tube": 0.1, "divisions": 12, "size": 1}},
    {"name": "pea", "mesh": {"shape": "sphere", "divisions": 1, "size": 0.05}}])");
  for (std::size_t f = 0; f < scene.frames; ++f) {
    const oracle::DistanceInterval is = distance(scene, scene.nodes_of_frame(f));
    EXPECT_NEAR(is.upper, 0.01, 1.5e-6) << f;
  }
}

// Two grains, and between them nothing that a ball of half a millimetre would meet.
TEST_F(SweepPoses, WhereAllWaysMissOneSentenceSaysSo) {
  scratch_.write("grains.obj",
                 "v -1 0 0\nv -1 1e-9 0\nv -1 0 1e-9\nv 1 0 0\nv 1 1e-9 0\nv 1 0 1e-9\n"
                 "f 1 2 3\nf 4 5 6\n");
  EXPECT_THAT(sentence_of([&] {
                placed(R"("sweep": {"separations": [0], "orientations": 1})", R"("bodies": [
    {"name": "grains", "mesh": {"file": "grains.obj"}},
    {"name": "pea", "mesh": {"shape": "sphere", "divisions": 1, "size": 0.0005}}])");
              }),
              testing::StartsWith("scene \"s\": of 200 ways for orientation 0 of its sweep none "
                                  "leads \"pea\" to \"grains\""));
}

}  // namespace
}  // namespace contactcheck::scene
