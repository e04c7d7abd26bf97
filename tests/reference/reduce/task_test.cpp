#include "reference/reduce/task.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/deform/recording.h"
#include "reference/judge/accuracy.h"
#include "reference/suite/case_file.h"
#include "reference/suite/job.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/approach_scene.h"
#include "tests/support/shapes.h"

namespace contactcheck::reduce {
namespace {

using nlohmann::json;
using test::Scratch;

/// A recording of two bodies, and a case of its frame 2.
class Case : public testing::Test {
 protected:
  Case()
      : scene_(test::approach_scene(
            test::make_body("", test::unit_box_mesh(1), {2, 2, 2}).shape,
            test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.5, 1), {3, 3, 3}).shape,
            {{0.0, 1.3}, {1.0, 0.7}}, 0.1, 0.2, 3, 0.35, {Level::kTriangle})),
        judged_(judge::judge_scene(scene_, progress_)) {
    std::filesystem::create_directories(scratch_.folder() / "recordings");
    std::filesystem::create_directories(scratch_.folder() / "cases");
    write_recording(scratch_.folder() / "recordings/approach.ccr",
                    {"approach", scene_.bodies, 0.1, nodes_of_frames()});
  }

  std::filesystem::path write(const std::string& level, ElementPair pair) {
    judge::Disagreement d;
    d.scene = "approach";
    d.detector = "fcl-aabb";
    d.level = level;
    d.kind = "missed";
    d.frame = 2;
    d.pair = pair;
    suite::write_case(file_, judged_, d, "../recordings/approach.ccr");
    return file_;
  }

  std::vector<std::vector<std::vector<Vec3>>> nodes_of_frames() const {
    std::vector<std::vector<std::vector<Vec3>>> nodes;
    for (std::size_t f = 0; f < scene_.frames; ++f) nodes.push_back(judged_.positions[f].nodes);
    return nodes;
  }

  process::SharedProgress page_;
  process::ProgressWriter progress_{&page_};
  scene::Scene scene_;
  judge::JudgedScene judged_;
  Scratch scratch_;
  std::filesystem::path file_ = scratch_.folder() / "cases/0001.json";
};

TEST_F(Case, BringsTheWholeFrameOfItsTwoBodies) {
  const ReductionTask task = read_case(write("triangle", {0, 1, 5, 17}));
  EXPECT_EQ(task.scene, "approach");
  EXPECT_EQ(task.frame, 2u);
  EXPECT_EQ(task.detector, "fcl-aabb");
  EXPECT_EQ(task.level, "triangle");
  EXPECT_EQ(task.kind, "missed");
  EXPECT_EQ(task.pair, (TrianglePair{5, 17}));
  ASSERT_EQ(task.snapshot.bodies.size(), 2u);
  EXPECT_EQ(task.snapshot.bodies[1].name, "moving");
  EXPECT_EQ(task.snapshot.nodes, judged_.positions[2].nodes);
}

TEST_F(Case, OfAVertexBringsATriangleWithItInTheOrderOfTheBodies) {
  const ReductionTask task = read_case(write("near", {1, 0, 9, 4}));
  EXPECT_EQ(task.snapshot.bodies[0].name, "resting");
  ASSERT_TRUE(task.pair);
  EXPECT_EQ((*task.pair)[0], 4u);
  const Triangle& t = scene_.bodies[1].shape->mesh.triangles[(*task.pair)[1]];
  EXPECT_TRUE(t[0] == 9 || t[1] == 9 || t[2] == 9);
}

TEST_F(Case, OfCellsBringsThem) {
  const ReductionTask task = read_case(write("box", {0, 1, 3, 8}));
  EXPECT_FALSE(task.pair);
  EXPECT_EQ(task.cells, (CellPair{3, 8}));
}

TEST_F(Case, OfBodiesHasNoTriangles) { EXPECT_FALSE(read_case(write("body", {0, 1, 0, 0})).pair); }

TEST_F(Case, WithoutARecordingIsItsTwoTriangles) {
  json c = json::parse(suite::read_text_file(write("triangle", {0, 1, 5, 17})));
  c.erase("recording");
  scratch_.write("cases/0001.json", c.dump());
  const ReductionTask task = read_case(file_);
  EXPECT_EQ(task.pair, (TrianglePair{0, 0}));
  const CaseCandidate pair = candidate_of(task.snapshot);
  EXPECT_EQ(pair.names[1], "moving");
  for (std::size_t side = 0; side < 2; ++side) {
    const Triangle& t = scene_.bodies[side].shape->mesh.triangles[side == 0 ? 5 : 17];
    ASSERT_EQ(pair.meshes[side].vertices.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(pair.meshes[side].vertices[i], judged_.positions[2].vertices[side][t[i]]);
  }
}

TEST_F(Case, IsToldFromAScene) {
  EXPECT_TRUE(is_case_file(write("triangle", {0, 1, 5, 17})));
  EXPECT_FALSE(is_case_file(scratch_.write("scene.json", R"({"id": "x", "bodies": []})")));
  EXPECT_FALSE(is_case_file(scratch_.folder() / "missing.json"));
}

TEST(TasksOfScene, GivesEveryFrameOrTheOneThatIsNamed) {
  const std::filesystem::path fixtures = CONTACTCHECK_FIXTURES;
  EXPECT_EQ(tasks_of_scene("hard-shared-edge", fixtures).size(), 12u);
  const std::vector<ReductionTask> one = tasks_of_scene("hard-shared-edge@1e-9", fixtures);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].frame, 5u);
  EXPECT_EQ(one[0].place, "value 1e-9 (frame 5)");
  EXPECT_EQ(one[0].snapshot.nodes[1].size(), 8u);
}

}  // namespace
}  // namespace contactcheck::reduce
