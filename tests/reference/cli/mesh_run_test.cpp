// run --mesh: a scene without a scene file.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "tests/reference/cli/program.h"
#include "tests/reference/cli/run_files.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/support/files.h"
#include "tests/support/mesh_text.h"
#include "tests/support/shapes.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::json;
using test::contactcheck_program;
using test::names_in;
using test::Outcome;
using test::text_of;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

class MeshRun : public testing::Test {
 protected:
  MeshRun() {
    write_ball(1);
    scratch_.write("cube.obj", test::obj_text(test::unit_box_mesh(2)));
  }

  void write_ball(int levels) const {
    scratch_.write("ball.obj", test::obj_text(test::sphere_mesh(Vec3::Zero(), 2.0, levels)));
  }
  std::string in(const std::string& name) const { return (scratch_.folder() / name).string(); }
  Words command(const Words& more, const std::string& out) const {
    Words words = {"run",         "--mesh",  in("ball.obj"), "--mesh",     in("cube.obj"),
                   "--no-timing", "--out",   in(out),        "--detector", "ffd-aabb-sphere2+tri",
                   "--detector",  "fcl-aabb"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  Outcome run(const Words& more, const std::string& out = "out") const {
    Words words = command(more, out);
    if (std::find(more.begin(), more.end(), "--resume") == more.end())
      words.insert(words.end(), {"--frames", "12"});
    return contactcheck_program(words);
  }
  // Ends a run when it has finished the scene of the meshes and is at work on another one.
  void interrupt_after_the_meshes() const {
    Words words = command({}, "out");
    words.push_back(scratch_.write("long.json", test::tiny_scene("long", "20000")).string());
    test::RunningProgram program(CONTACTCHECK_PROGRAM, words);
    const fs::path kept = scratch_.folder() / "out/partial/ball-cube-approach.partial.json";
    for (int i = 0; i < 12'000 && !program.has_ended() && !fs::exists(kept); ++i) usleep(5'000);
    ASSERT_TRUE(fs::exists(kept));
    program.send(SIGKILL);
    EXPECT_EQ(program.outcome().exit_code, 128 + SIGKILL);
  }
  json results(const std::string& out = "out") const {
    return json::parse(text_of(scratch_.folder() / out / "results.json"));
  }
  static std::vector<std::string> hashes(const json& results) {
    std::vector<std::string> out;
    for (const json& run : results.at("runs")) out.push_back(run.at("contact_hash"));
    return out;
  }

  const test::Scratch scratch_;
};

TEST_F(MeshRun, JudgesTheMeshesAsAScene) {
  const Outcome outcome = run({});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json all = results();
  const json scene = all.at("scenes").at(0);
  EXPECT_EQ(scene.at("id"), "ball-cube-approach");
  EXPECT_EQ(scene.at("frames"), 12);
  EXPECT_EQ(scene.at("bodies").at(0).at("name"), "ball");
  EXPECT_GT(scene.at("contact_frames"), 0);
  EXPECT_LT(scene.at("contact_frames"), 12);
  for (const json& run : all.at("runs")) {
    EXPECT_EQ(run.at("status"), "ok");
    EXPECT_EQ(run.at("contact_hash"), scene.at("truth_hash"));
  }
  EXPECT_EQ(names_in(scratch_.folder() / "out"), test::run_files());
  EXPECT_TRUE(fs::exists(scratch_.folder() / "out/recordings/ball-cube-approach.ccr"));
  EXPECT_TRUE(fs::exists(scratch_.folder() / "out/contacts/ball-cube-approach.json"));
}

TEST_F(MeshRun, TheSavedSceneIsTheSameScene) {
  const Outcome outcome = run({"--save-scene", in("mine.json"), "--motion", "twist"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Outcome again = contactcheck_program({"run", in("mine.json"), "--frames", "12",
                                              "--no-timing", "--out", in("again"), "--detector",
                                              "ffd-aabb-sphere2+tri", "--detector", "fcl-aabb"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(hashes(results("again")), hashes(results()));
  EXPECT_EQ(results("again").at("scenes").at(0).at("id"), "ball-cube-twist");
}

TEST_F(MeshRun, ASavedSceneIsNotWrittenOver) {
  scratch_.write("mine.json", "my work");
  const Outcome outcome = run({"--save-scene", in("mine.json")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "contactcheck: --save-scene: \"" + in("mine.json") +
                             "\" is there already and is not written over\n");
  EXPECT_EQ(text_of(scratch_.folder() / "mine.json"), "my work");
}

// A kept scene is taken over as long as the meshes are what they were.
TEST_F(MeshRun, ResumesOnlyWithTheSameMeshes) {
  const auto resumed = [&] {
    const Outcome outcome = run({"--resume"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return results().at("resumed");
  };
  interrupt_after_the_meshes();
  EXPECT_EQ(resumed(), json::array({"ball-cube-approach"}));
  interrupt_after_the_meshes();
  write_ball(2);
  EXPECT_EQ(resumed(), json::array());
}

TEST_F(MeshRun, SizeFileKeepsTheSizes) {
  ASSERT_EQ(run({"--size", "file"}).exit_code, 0);
  EXPECT_DOUBLE_EQ(results().at("scenes").at(0).at("size"), 4.0);
  ASSERT_EQ(run({"--size", "0.125"}).exit_code, 0);
  EXPECT_DOUBLE_EQ(results().at("scenes").at(0).at("size"), 0.125);
}

TEST_F(MeshRun, MeshFilesNeedNoFlag) {
  const Words words = {"run",   in("ball.obj"), in("cube.obj"), "--no-timing", "--motion",
                       "press", "--frames",     "12",           "--out",       in("bare")};
  const Outcome outcome = contactcheck_program(words);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json all = results("bare");
  EXPECT_EQ(all.at("scenes").at(0).at("id"), "ball-cube-press");
  Words detectors;
  for (const json& run : all.at("runs")) detectors.push_back(run.at("detector"));
  EXPECT_EQ(detectors, (Words{"fcl-aabb", "embree", "bullet-gimpact", "bullet-vf",
                              "ffd-aabb-sphere2", "ffd-aabb-sphere2+tri", "ffd-lazy"}));
}

TEST_F(MeshRun, SaysWhatBecomesOfTheSizes) {
  EXPECT_THAT(run({}).err, HasSubstr("ball: 4 m, scaled to 1 m (--size file keeps it)\n"));
  const Outcome kept = run({"--size", "file"});
  EXPECT_THAT(kept.err, HasSubstr("ball: 4 m\n"));
  EXPECT_THAT(kept.err, Not(HasSubstr("warning")));
  scratch_.write("cube.obj", test::obj_text(test::sphere_mesh(Vec3::Zero(), 0.01, 1)));
  EXPECT_THAT(run({}).err, HasSubstr("warning: ball is 200 times as large as cube in its file; do "
                                     "both have one unit of length?\n"));
  EXPECT_EQ(run({"--quiet"}).err, "");
}

TEST_F(MeshRun, SaysWhatTheMeshCheckFound) {
  TriangleMesh open = test::unit_box_mesh(1);
  open.triangles.pop_back();
  scratch_.write("cube.obj", test::obj_text(open));
  const std::string err = run({}).err;
  EXPECT_THAT(err, HasSubstr("\ncube: 3 boundary-edge (first: triangle "));
  EXPECT_THAT(err, HasSubstr("\ncube: not closed, so containment is not judged\n"));
  EXPECT_THAT(err, Not(HasSubstr("\nball: 0 ")));
  EXPECT_THAT(err, Not(HasSubstr("\nball: not closed")));
}

TEST_F(MeshRun, TakesTheDetectorsOfASuite) {
  const Outcome outcome = contactcheck_program(
      {"run", in("ball.obj"), in("cube.obj"), "--no-timing", "--detectors", "scaling", "--detector",
       "fcl-collide", "--frames", "4", "--out", in("suite")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  Words detectors;
  const json all = results("suite");
  for (const json& run : all.at("runs")) detectors.push_back(run.at("detector"));
  EXPECT_EQ(detectors, (Words{"ffd-lazy", "full-refit", "embree", "fcl-aabb", "fcl-collide"}));
}

struct RefusedWords {
  Words words;
  std::string sentence;
};

TEST_F(MeshRun, RefusesBadWords) {
  const std::vector<RefusedWords> all = {
      {{"run", "--mesh", in("ball.obj")}, "one mesh meets nothing"},
      {{"run", "--motion", "press"}, "--motion requires --mesh"},
      {{"run", "--size", "2"}, "--size requires --mesh"},
      {{"run", in("ball.obj")}, "one mesh meets nothing"},
      {{"run", in("ball.obj"), in("cube.obj"), "--detectors", "contact"},
       "--detectors: \"contact\" is no suite"},
      {{"run", "--mesh", in("ball.obj"), "--mesh", in("none.obj")}, "none.obj\" does not exist"},
      {{"run", "--mesh", in("ball.obj"), "--mesh", in("ball.obj"), "--motion", "x"},
       "--motion: \"x\" is not one of approach, press, twist, pass"},
  };
  for (const RefusedWords& refused : all) {
    const Outcome outcome = contactcheck_program(refused.words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(refused.sentence));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  for (const char* size : {"0", "-1", "nan", "inf", "1e7", "big", ""}) {
    const Outcome outcome = run({"--size", size});
    EXPECT_EQ(outcome.exit_code, 2) << size;
    EXPECT_THAT(outcome.err, HasSubstr("--size: \"" + std::string(size) +
                                       "\" is neither \"file\" nor a number of metres above 0"));
  }
  EXPECT_FALSE(fs::exists(scratch_.folder() / "out"));
}

}  // namespace
}  // namespace contactcheck::cli
