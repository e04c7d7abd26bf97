// Bad input: exit code 2, one sentence on stderr that names the culprit, nothing written.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/reference/cli/program.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using test::contactcheck_program;
using test::Outcome;
using test::Scratch;
using test::tiny_scene;
using testing::HasSubstr;
using Words = std::vector<std::string>;

class BadInput : public testing::Test {
 protected:
  void expect_refused(const Words& arguments, const std::vector<std::string>& named) {
    const Outcome outcome = contactcheck_program(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, testing::StartsWith("contactcheck: "));
    for (const std::string& word : named) EXPECT_THAT(outcome.err, HasSubstr(word));
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(fs::exists(out())) << "nothing may be written";
  }
  void expect_run_refused(Words arguments, const std::vector<std::string>& named) {
    arguments.insert(arguments.begin(), "run");
    arguments.insert(arguments.end(), {"--out", out().string()});
    expect_refused(arguments, named);
  }
  void expect_reproduce_refused(Words arguments, const std::vector<std::string>& named) {
    arguments.insert(arguments.begin(), "reproduce");
    arguments.insert(arguments.end(), {"--out", out().string()});
    expect_refused(arguments, named);
  }
  // A scene file of its own with one thing replaced.
  void expect_scene_refused(const std::string& from, const std::string& to,
                            const std::vector<std::string>& named) {
    std::string text = tiny_scene();
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
    const std::string file = scratch_.write("bad.json", text).string();
    std::vector<std::string> all = named;
    all.push_back(file);
    expect_run_refused({file}, all);
  }
  std::string scene() { return scratch_.write("tiny.json", tiny_scene()).string(); }
  fs::path out() const { return scratch_.folder() / "out"; }

  Scratch scratch_;
};

TEST_F(BadInput, NoSubcommand) { expect_refused({}, {"which command?", "--help"}); }

TEST_F(BadInput, UnknownSubcommand) {
  expect_refused({"frobnicate"}, {"unknown command", "\"frobnicate\""});
  expect_refused({"--frobnicate"}, {"--frobnicate"});
}

TEST_F(BadInput, UnknownScene) { expect_run_refused({"rabbit-hole"}, {"\"rabbit-hole\""}); }

TEST_F(BadInput, ReproduceOfAnUnknownScene) {
  expect_reproduce_refused({"paper-rabbit-hole"}, {"\"paper-rabbit-hole\"", "paper-teapot"});
  expect_reproduce_refused({"bunny-touch"}, {"\"bunny-touch\" is no scene of the paper"});
  expect_reproduce_refused({"paper-rabbit-full"}, {"paper-rabbit-full"});
}

TEST_F(BadInput, ReproduceOfNothing) {
  expect_reproduce_refused({scene(), "--frames", "0"}, {"--frames", "0"});
  expect_reproduce_refused({scene(), "--repeat", "0"}, {"--repeat", "0"});
}

TEST_F(BadInput, ReproduceChoosesItsDetectorsItself) {
  expect_reproduce_refused({scene(), "--detector", "fcl-aabb"}, {"--detector"});
}

TEST_F(BadInput, SceneFileThatIsNotThere) {
  expect_run_refused({"/nonexistent/scene.json"}, {"/nonexistent/scene.json"});
}

// Before the scenes beside it have run.
TEST_F(BadInput, SimulationThatCannotStart) {
  const auto simulated = [&](const std::string& name, const std::string& material,
                             const std::string& driver) {
    return scratch_.write(name, R"({"id": "falls", "frames": 2, "levels": ["triangle"], "bodies": [
      {"name": "a", "mesh": {"shape": "box"}, "lattice": {"cells": [2, 2, 2]},
       "material": {"model": "mass-spring", )" +
                                    material + R"(}, "motion": {"position": [0, 3, 0]}},
      {"name": "b", "mesh": {"shape": "box"}, "lattice": {"cells": [2, 2, 2]}}],
      "simulation": {"driver": ")" + driver +
                                    R"("}})");
  };
  expect_run_refused({scene(), simulated("driver.json", R"("mass": 1)", "nope")},
                     {"driver.json", "scene \"falls\"", "unknown detector \"nope\""});
  expect_run_refused({scene(), simulated("stiff.json", R"("mass": 1e-300)", "ffd-lazy")},
                     {"stiff.json", "body \"a\" is too stiff"});
}

TEST_F(BadInput, UnknownDetector) {
  expect_run_refused({scene(), "--detector", "fcl-magic"}, {"\"fcl-magic\"", "list"});
}

TEST_F(BadInput, UnknownDetectorAfterAGoodOne) {
  expect_run_refused({scene(), "--detector", "fcl-aabb", "--detector", "nope"}, {"\"nope\""});
}

TEST_F(BadInput, UnknownDetectorOption) {
  expect_run_refused({scene(), "--detector", "ffd-aabb:colour=red"}, {"\"colour\"", "ffd-aabb"});
}

TEST_F(BadInput, DetectorOptionOutOfRange) {
  expect_run_refused({scene(), "--detector", "ffd-aabb:cell=-1"}, {"cell", "\"-1\""});
  expect_run_refused({scene(), "--detector", "ffd-aabb:bounds=loose"}, {"bounds", "\"loose\""});
}

TEST_F(BadInput, UnknownFlag) { expect_run_refused({scene(), "--frobnicate"}, {"--frobnicate"}); }

TEST_F(BadInput, FlagWithoutItsValue) { expect_refused({"run", "--detector"}, {"--detector"}); }

TEST_F(BadInput, ZeroAndNegativeFrames) {
  expect_run_refused({scene(), "--frames", "0"}, {"--frames", "0"});
  expect_run_refused({scene(), "--frames", "-3"}, {"--frames", "-3"});
  expect_run_refused({scene(), "--frames", "many"}, {"--frames", "many"});
}

TEST_F(BadInput, NumbersAreDecimal) {
  expect_run_refused({scene(), "--frames", "010"}, {"--frames", "010"});
  expect_run_refused({scene(), "--frames", "0x10"}, {"--frames", "0x10"});
  expect_run_refused({scene(), "--processes", "08"}, {"--processes", "08"});
  expect_run_refused({scene(), "--processes", "3.0"}, {"--processes", "3.0"});
}

TEST_F(BadInput, LimitsOutOfRange) {
  expect_run_refused({scene(), "--call-limit", "0"}, {"--call-limit", "0"});
  expect_run_refused({scene(), "--call-limit", "nan"}, {"--call-limit", "nan"});
  expect_run_refused({scene(), "--memory-limit", "1"}, {"--memory-limit", "1"});
  expect_run_refused({scene(), "--memory-limit", "-5"}, {"--memory-limit", "-5"});
}

TEST_F(BadInput, NoProcesses) {
  expect_run_refused({scene(), "--processes", "0"}, {"--processes"});
}

TEST_F(BadInput, ZeroFramesInTheScene) {
  expect_scene_refused(R"("frames": 5)", R"("frames": 0)", {"frames"});
  expect_scene_refused(R"("frames": 5)", R"("frames": -5)", {"frames", "-5"});
}

TEST_F(BadInput, NegativeSizes) {
  expect_scene_refused(R"("divisions": 2)", R"("size": -1)", {"bodies[0].mesh.size", "-1"});
  expect_scene_refused(R"("divisions": 2)", R"("sides": [1, -1, 1])",
                       {"bodies[0].mesh.sides", "-1"});
  expect_scene_refused("[3, 3, 3]", "[3, -3, 3]", {"bodies[0].lattice.cells", "-3"});
}

TEST_F(BadInput, BrokenJson) {
  expect_scene_refused(R"("title": )", R"("title" )", {});
  const std::string cut = scratch_.write("cut.json", tiny_scene().substr(0, 100)).string();
  expect_run_refused({cut}, {cut});
  const std::string empty = scratch_.write("empty.json", "").string();
  expect_run_refused({empty}, {empty});
}

TEST_F(BadInput, UnreadableMesh) {
  scratch_.write("broken.obj", "v 0 0 zero\nf 1 2 3\n");
  expect_scene_refused(R"("shape": "box", "divisions": 2)", R"("file": "broken.obj")",
                       {"broken.obj"});
  expect_scene_refused(R"("shape": "box", "divisions": 2)", R"("file": "missing.off")",
                       {"missing.off"});
}

TEST_F(BadInput, OneBadSceneAmongGoodOnesStopsTheRunBeforeItBegins) {
  const std::string bad = scratch_.write("bad.json", "{").string();
  expect_run_refused({scene(), bad}, {bad});
}

TEST_F(BadInput, TwoScenesOfOneId) {
  const std::string other = scratch_.write("other.json", tiny_scene()).string();
  expect_run_refused({scene(), other}, {"\"tiny\""});
}

TEST_F(BadInput, BrokenRecording) {
  const std::string file = scratch_.write("x.ccr", "not a recording").string();
  expect_run_refused({file}, {file});
}

TEST_F(BadInput, OutBelowAFile) {
  const fs::path file = scratch_.write("file", "keep me");
  expect_refused({"run", scene(), "--out", (file / "deeper").string()}, {"--out", file.string()});
}

TEST_F(BadInput, OutThatIsAFile) {
  const fs::path file = scratch_.write("file", "keep me");
  expect_refused({"run", scene(), "--out", file.string()}, {"--out", file.string()});
  EXPECT_EQ(fs::file_size(file), 7u);
}

TEST_F(BadInput, OutThatCannotBeMade) {
  // Nobody can make a folder there, not even root.
  expect_refused({"run", scene(), "--out", "/proc/contactcheck"}, {"--out", "/proc/contactcheck"});
}

TEST_F(BadInput, OutThatExistsAndTakesNoFiles) {
  expect_refused({"run", scene(), "--out", "/proc/self"}, {"/proc/self"});
}

TEST_F(BadInput, ReportOfNoResults) {
  const std::string missing = (scratch_.folder() / "missing.json").string();
  const std::string broken = scratch_.write("broken.json", "{\"schema\": ").string();
  const std::string other = scratch_.write("other.json", "{\"schema\": \"else/1\"}").string();
  const std::string list = scratch_.write("list.json", "[1, 2]").string();
  const std::string half =
      scratch_.write("half.json", R"({"schema": "contactcheck-results/2"})").string();
  for (const std::string& file : {missing, broken, other, list, half})
    expect_refused({"report", file, "--out", out().string()}, {file});
  expect_refused({"report", scratch_.folder().string(), "--out", out().string()}, {"is a folder"});
}

TEST_F(BadInput, ReportOfNoKnownFormat) {
  expect_refused({"report", "results.json", "--format", "docx", "--out", out().string()},
                 {"--format", "\"docx\""});
}

}  // namespace
}  // namespace contactcheck::cli
