#include <gmock/gmock.h>

#include <cmath>

#include "core/deform/mapping.h"
#include "core/deform/recording.h"
#include "reference/scene/scene.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::scene {
namespace {

using test::Scratch;
using test::sentence_of;

std::string scene_of(const std::string& bodies, const std::string& times = R"("duration": 2)") {
  return R"({"id": "s", "title": "A scene", "frames": 4, )" + times +
         R"(, "levels": ["body", "triangle"], "bodies": [)" + bodies + "]}";
}

const std::string kBox = R"({"name": "a", "mesh": {"shape": "box", "divisions": 4},
                             "lattice": {"cells": [2, 2, 2]}})";

Scene load(const std::string& text, std::size_t frames = 0) {
  const Scratch scratch;
  return load_scene(scratch.write("s.json", text), frames);
}

TEST(SceneFile, ReadsItsHead) {
  const Scene scene = load(scene_of(kBox));
  EXPECT_EQ(scene.id, "s");
  EXPECT_EQ(scene.title, "A scene");
  EXPECT_EQ(scene.frames, 4u);
  EXPECT_EQ(scene.time_step, 0.5);
  EXPECT_EQ(scene.time_of(3), 1.5);
  EXPECT_TRUE(scene.judges(Level::kTriangle));
  EXPECT_FALSE(scene.judges(Level::kBox));
  EXPECT_TRUE(scene.scripted());
  EXPECT_EQ(scene.size(), 1.0);
}

TEST(SceneFile, WantedFramesKeepTheDuration) {
  EXPECT_EQ(load(scene_of(kBox), 8).time_step, 0.25);
  const Scene stepped = load(scene_of(kBox, R"("time_step": 0.1)"), 2);
  EXPECT_EQ(stepped.frames, 2u);
  EXPECT_DOUBLE_EQ(stepped.time_step, 0.2);
  EXPECT_EQ(load(scene_of(kBox, R"("time_step": 0.1)")).time_step, 0.1);
}

TEST(SceneFile, EqualMeshAndLatticeShareOneShape) {
  const auto body = [](const std::string& name, const std::string& mesh,
                       const std::string& lattice) {
    return R"({"name": ")" + name + R"(", "mesh": )" + mesh + R"(, "lattice": )" + lattice + "}";
  };
  const std::string mesh = R"({"shape": "sphere", "divisions": 2})";
  const std::string same = R"({"divisions": 2.0, "shape": "sphere"})";
  const std::string kept = R"({"kept": 20})";
  const Scene scene = load(scene_of(body("a", mesh, kept) + "," + body("b", same, kept) + "," +
                                    body("c", mesh, R"({"kept": 60})") + "," +
                                    body("d", R"({"shape": "sphere", "size": 2})", kept)));
  EXPECT_EQ(scene.bodies[0].shape, scene.bodies[1].shape);
  EXPECT_NE(scene.bodies[0].shape, scene.bodies[2].shape);
  EXPECT_NE(scene.bodies[0].shape, scene.bodies[3].shape);
  EXPECT_EQ(scene.size(), 2.0);
}

TEST(SceneFile, MeshIsScaledAndMoved) {
  const Scene scene = load(scene_of(
      R"({"name": "a", "mesh": {"shape": "box", "sides": [1, 2, 4], "size": 2, "center": [5, 0, 0]}},
         {"name": "b", "mesh": {"shape": "box", "scale": 3}})"));
  const Aabb a = bounding_box(scene.bodies[0].shape->mesh.vertices);
  EXPECT_EQ(a.lo, Vec3(4.75, -0.5, -1));
  EXPECT_EQ(a.hi, Vec3(5.25, 0.5, 1));
  EXPECT_EQ(bounding_box(scene.bodies[1].shape->mesh.vertices).hi, Vec3(1.5, 1.5, 1.5));
  EXPECT_FALSE(scene.bodies[0].shape->lattice.has_value());
}

TEST(SceneFile, BodyWithoutMotionKeepsItsBits) {
  const Scratch scratch;
  scratch.write("meshes/t.off", "OFF\n3 1 0\n0.1 0.2 0.7\n1.3 0 0\n0 1.1 0\n3 0 1 2\n");
  const Scene scene = load_scene(
      scratch.write("s.json", scene_of(R"({"name": "a", "mesh": {"file": "meshes/t.off"}})")));
  EXPECT_EQ(scene.nodes_of_frame(3)[0], scene.bodies[0].shape->mesh.vertices);
  EXPECT_EQ(scene.bodies[0].shape->mesh.vertices[0], Vec3(0.1, 0.2, 0.7));
  EXPECT_EQ(scene.origins[0].source, (scratch.folder() / "meshes/t.off").string());
  EXPECT_EQ(scene.origins[0].notes, "3 boundary-edge (first: triangle 0)");
}

TEST(SceneFile, SimplifiedMeshSaysSo) {
  const Scene scene = load(
      scene_of(R"({"name": "a", "mesh": {"shape": "letter", "letter": "B", "triangles": 2402}})"));
  EXPECT_EQ(scene.bodies[0].shape->mesh.triangles.size(), 2402u);
  EXPECT_EQ(scene.origins[0].source, "letter B, 4 divisions, simplified to 2402 triangles");
}

// The motion of the box's corner (0.5, 0.5, 0.5) at a time.
Vec3 corner_at(const std::string& motion, double time) {
  const Scene scene =
      load(scene_of(R"({"name": "a", "mesh": {"shape": "box"}, "motion": )" + motion + "}"));
  const std::vector<Vec3>& rest = scene.bodies[0].shape->mesh.vertices;
  const auto corner = std::find(rest.begin(), rest.end(), Vec3(0.5, 0.5, 0.5));
  return scene.nodes_at(time)[0][static_cast<std::size_t>(corner - rest.begin())];
}

void expect_near(const Vec3& a, const Vec3& b) {
  EXPECT_LT((a - b).norm(), 1e-12) << a.transpose();
}

TEST(SceneFile, PositionRunsThroughItsKeys) {
  const std::string keys = R"({"position": [[0, [0, 0, 0]], [2, [4, 0, 0]]]})";
  expect_near(corner_at(keys, 0.5), Vec3(1.5, 0.5, 0.5));
  expect_near(corner_at(keys, 9), Vec3(4.5, 0.5, 0.5));
  const std::string eased = R"({"ease": "smooth", "position": [[0, [0, 0, 0]], [2, [4, 0, 0]]]})";
  expect_near(corner_at(eased, 0.5), Vec3(0.5 + 4 * 0.15625, 0.5, 0.5));
  expect_near(corner_at(R"({"position": [1, 2, 3]})", 0), Vec3(1.5, 2.5, 3.5));
}

TEST(SceneFile, SpinsTurnAboutTheRestCentre) {
  expect_near(corner_at(R"({"spins": [{"axis": "z", "degrees": 90}]})", 0), Vec3(-0.5, 0.5, 0.5));
  expect_near(corner_at(R"({"spins": [{"axis": [0, 2, 0], "degrees": [[0, 0], [1, 90]]}]})", 1),
              Vec3(0.5, 0.5, -0.5));
}

TEST(SceneFile, DeformersDoWhatTheySay) {
  expect_near(corner_at(R"({"deformers": [{"taper": {"axis": "y", "amount": 0.5}}]})", 0),
              Vec3(0.75, 0.5, 0.75));
  expect_near(corner_at(R"({"deformers": [{"stretch": {"axis": "x", "amount": 3}}]})", 0),
              Vec3(2, 0.25, 0.25));
  const double turned = 0.5 * std::sqrt(2.0);
  expect_near(corner_at(R"({"deformers": [{"twist": {"axis": "z", "degrees": 90}}]})", 0),
              Vec3(0, turned, 0.5));
}

TEST(SceneFile, NodeKeysMoveSingleNodes) {
  const Scene scene = load(scene_of(R"({"name": "a", "mesh": {"shape": "box"},
    "lattice": {"cells": [1, 1, 1]}, "motion": {"deformers": [
      {"nodes": [[0, []], [1, [{"node": [1, 1, 1], "offset": [0, 0, 2]}]]]}]}})"));
  const std::vector<Vec3> rest = scene.nodes_at(0)[0], half = scene.nodes_at(0.5)[0];
  expect_near(half[7], rest[7] + Vec3(0, 0, 1));
  expect_near(half[6], rest[6]);
}

TEST(SceneFile, RecordingBecomesAScene) {
  const Scratch scratch;
  const Scene scene = load(scene_of(kBox));
  const Recording recording{
      "s", scene.bodies, scene.time_step, {scene.nodes_of_frame(0), scene.nodes_of_frame(1)}};
  write_recording(scratch.folder() / "s.ccr", recording);
  const Scene replayed = load_recording(scratch.folder() / "s.ccr");
  EXPECT_EQ(replayed.id, "s");
  EXPECT_EQ(replayed.frames, 2u);
  EXPECT_FALSE(replayed.scripted());
  EXPECT_EQ(replayed.nodes_of_frame(1), scene.nodes_of_frame(1));
  EXPECT_EQ(replayed.origins.size(), 1u);
  EXPECT_TRUE(replayed.judges(Level::kBox));
}

}  // namespace
}  // namespace contactcheck::scene
