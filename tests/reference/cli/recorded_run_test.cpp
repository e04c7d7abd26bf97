// Recorded deformation through the whole program: a scene's own frames, as files, give its answers.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/scene/scene.h"
#include "tests/reference/cli/program.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/support/cache_bytes.h"
#include "tests/support/files.h"
#include "tests/support/mesh_text.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::json;
using test::contactcheck_program;
using test::Outcome;
using test::text_of;
using testing::HasSubstr;
using Words = std::vector<std::string>;

class RecordedRun : public testing::Test {
 protected:
  std::string in(const std::string& name) const { return (scratch_.folder() / name).string(); }

  json run(const std::string& scene, const Words& detectors) const {
    Words words = {"run", in(scene), "--no-timing", "--out", in("out")};
    for (const std::string& detector : detectors)
      words.insert(words.end(), {"--detector", detector});
    const Outcome outcome = contactcheck_program(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Outcome valid = test::run_program(CONTACTCHECK_PYTHON3,
                                            {"-B", CONTACTCHECK_VALIDATOR, in("out/results.json")});
    EXPECT_EQ(valid.exit_code, 0) << valid.out << valid.err;
    return json::parse(text_of(scratch_.folder() / "out/results.json"));
  }

  // The deformed surfaces of a scene, one OBJ file per body and frame.
  void write_frames(const scene::Scene& scene) const {
    for (std::size_t f = 0; f < scene.frames; ++f) {
      const auto nodes = scene.nodes_of_frame(f);
      for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        TriangleMesh mesh = scene.bodies[b].shape->mesh;
        map_body(*scene.bodies[b].shape, nodes[b], mesh.vertices);
        scratch_.write(scene.bodies[b].name + "_" + std::to_string(f) + ".obj",
                       test::obj_text(mesh));
      }
    }
  }

  static std::string recorded(const std::string& lattice = "") {
    const auto body = [&](const std::string& name) {
      return R"({"name": ")" + name + R"(", "recording": {"frames": ")" + name + R"(_%d.obj"})" +
             (lattice.empty() ? "" : R"(, "lattice": )" + lattice) + "}";
    };
    return R"({"id": "recorded", "duration": 1, "levels": ["body", "cell", "triangle", "vertex"],
      "bodies": [)" +
           body("left") + ", " + body("right") + "]}";
  }

  const test::Scratch scratch_;
};

TEST_F(RecordedRun, FramesOfASceneGiveItsContactHash) {
  const fs::path file = scratch_.write("tiny.json", test::tiny_scene("tiny", "9"));
  const json scripted = run("tiny.json", {"fcl-aabb", "aabb-tree", "spatial-hash"});
  write_frames(scene::load_scene(file));
  scratch_.write("recorded.json", recorded());
  const json replayed =
      run("recorded.json", {"fcl-aabb", "aabb-tree", "spatial-hash", "ffd-aabb-sphere2+tri"});
  EXPECT_GT(scripted["scenes"][0]["truth"]["triangle"], 0);
  EXPECT_EQ(replayed["scenes"][0]["frames"], 9);
  EXPECT_EQ(replayed["scenes"][0]["truth_hash"], scripted["scenes"][0]["truth_hash"]);
  for (int d = 0; d < 3; ++d) {
    EXPECT_EQ(replayed["runs"][d]["status"], "ok");
    EXPECT_EQ(replayed["runs"][d]["contact_hash"], scripted["runs"][d]["contact_hash"]);
  }
  // Who needs a lattice says so, and is judged nowhere.
  EXPECT_EQ(replayed["runs"][3]["status"], "refused");
  EXPECT_THAT(replayed["runs"][3]["message"].get<std::string>(),
              HasSubstr("needs a lattice for every body; a body of a scene file gets one by "
                        "\"lattice\": {\"kept\": 150, \"fit\": true}"));
  EXPECT_FALSE(replayed["scenes"][0].contains("fits"));
}

// What lattices of the same cells made, they can make again; then everybody joins.
TEST_F(RecordedRun, AFittedLatticeLetsFfdDetectorsJoinAndTellsItsError) {
  const fs::path file = scratch_.write("tiny.json", test::tiny_scene("tiny", "9"));
  write_frames(scene::load_scene(file));
  scratch_.write("recorded.json", recorded(R"({"cells": [3, 3, 3], "fit": true})"));
  const json fitted = run("recorded.json", {"fcl-aabb", "ffd-aabb-sphere2+tri", "ffd-lazy"});
  const json scene = fitted["scenes"][0];
  ASSERT_EQ(scene["fits"].size(), 2u);
  EXPECT_EQ(scene["fits"][1]["body"], "right");
  ASSERT_EQ(scene["fits"][1]["max"].size(), 9u);
  for (const json& max : scene["fits"][1]["max"]) EXPECT_LT(max.get<double>(), 1e-4);
  EXPECT_GT(scene["truth"]["triangle"], 0);
  for (const json& r : fitted["runs"]) {
    EXPECT_EQ(r["status"], "ok") << r["message"];
    EXPECT_EQ(r["contact_hash"], scene["truth_hash"]) << "all are given the fitted surface";
  }
  EXPECT_THAT(text_of(scratch_.folder() / "out/report.md"),
              HasSubstr("Lattices fitted to recordings"));
}

// A cache that changes is another scene, though no scene file has changed.
TEST_F(RecordedRun, ChangedCachesAreAnotherScene) {
  const TriangleMesh mesh{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}}};
  scratch_.write("rest.obj", test::obj_text(mesh));
  scratch_.write("s.json", R"({"id": "s", "duration": 1, "levels": ["triangle"], "bodies": [
    {"name": "sheet", "mesh": {"file": "rest.obj"}, "recording": {"cache": "a.mdd"}},
    {"name": "box", "mesh": {"shape": "box"}}]})");
  scratch_.write("a.mdd", test::mdd_bytes({mesh.vertices, mesh.vertices}));
  const json touching = run("s.json", {"fcl-aabb"});
  const std::vector<Vec3> away = {Vec3(5, 0, 0), Vec3(6, 0, 0), Vec3(5, 1, 0)};
  scratch_.write("a.mdd", test::mdd_bytes({away, away}));
  const json apart = run("s.json", {"fcl-aabb"});
  EXPECT_EQ(touching["scenes"][0]["contact_frames"], 2);
  EXPECT_EQ(apart["scenes"][0]["contact_frames"], 0);
}

}  // namespace
}  // namespace contactcheck::cli
