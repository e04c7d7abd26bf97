// Whole runs in closed loop: `run --closed-loop` on two falling boxes, `reproduce` on a scene of
// the paper.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/reference/cli/program.h"
#include "tests/reference/cli/run_files.h"
#include "tests/reference/scene/installed.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::contactcheck_program;
using test::names_in;
using test::Outcome;
using test::Scratch;
using test::text_of;
using testing::ElementsAre;
using testing::HasSubstr;

// One box rests on the ground, the other falls on it: in contact from frame 5 on.
const char* const kFallingBoxes = R"({
  "id": "falling-boxes", "title": "Two boxes", "frames": 8,
  "simulation": {"every": 2, "ground": {}},
  "levels": ["body", "cell", "triangle", "vertex"],
  "bodies": [
    {"name": "lower", "mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [2, 2, 2]},
     "motion": {"position": [0, 0.52, 0]},
     "material": {"model": "mass-spring", "mass": 10, "stiffness": 2000, "damping": 3}},
    {"name": "upper", "mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [2, 2, 2]},
     "motion": {"position": [0.1, 1.7, 0.1]},
     "material": {"model": "mass-spring", "mass": 10, "stiffness": 2000, "damping": 3}}]
})";

class ClosedLoopCommand : public testing::Test {
 protected:
  // Expects the program to end well and its results to satisfy schema and sums.
  json run(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--quiet", "--out", out().string()});
    last_ = contactcheck_program(arguments);
    EXPECT_EQ(last_.exit_code, 0) << last_.err;
    const Outcome valid = test::run_program(
        CONTACTCHECK_PYTHON3,
        {"-B", CONTACTCHECK_VALIDATOR, "--described", (out() / "results.json").string()});
    EXPECT_EQ(valid.exit_code, 0) << valid.out << valid.err;
    return json::parse(text_of(out() / "results.json"));
  }
  json run_boxes(std::vector<std::string> arguments) {
    const std::string scene = scratch_.write("boxes.json", kFallingBoxes).string();
    const std::vector<std::string> all = {
        "run", scene, "--detector", "ffd-aabb-sphere2+tri", "--detector", "fcl-collide"};
    arguments.insert(arguments.begin(), all.begin(), all.end());
    return run(arguments);
  }
  fs::path out() const { return scratch_.folder() / "out"; }

  Scratch scratch_;
  Outcome last_;
};

TEST_F(ClosedLoopCommand, EveryDetectorDrivesAndIsTimedInWholeSteps) {
  const json results = run_boxes({"--closed-loop", "--processes", "1"});
  ASSERT_EQ(results.at("runs").size(), 2u);
  for (const json& run : results.at("runs")) {
    const json &loop = run.at("closed_loop"), &step = run.at("step_ms");
    EXPECT_EQ(loop.at("error"), "") << run.at("detector");
    EXPECT_EQ(loop.at("steps"), 16) << run.at("detector");
    EXPECT_GT(loop.at("levels").at("triangle").at("truth"), 0) << run.at("detector");
    EXPECT_EQ(loop.at("levels").at("triangle").at("recall"), 1.0) << run.at("detector");
    EXPECT_EQ(loop.at("tunnelling_events"), 0) << run.at("detector");
    EXPECT_EQ(step.at("steps"), 16) << "the motion has no more";
    EXPECT_EQ(step.at("repeats"), 5) << run.at("detector");
    EXPECT_GT(step.at("total"), 0.0) << run.at("detector");
  }
  EXPECT_EQ(results.at("scenes").at(0).at("simulation").at("every"), 2);
}

TEST_F(ClosedLoopCommand, WithoutTimingNoStepIsTimed) {
  const json results = run_boxes({"--closed-loop", "--no-timing"});
  EXPECT_TRUE(results.at("runs").at(0).contains("closed_loop"));
  EXPECT_FALSE(results.at("runs").at(0).contains("step_ms"));
}

TEST_F(ClosedLoopCommand, WithoutTheFlagThereIsNone) {
  const json results = run_boxes({"--no-timing"});
  for (const json& run : results.at("runs")) {
    EXPECT_FALSE(run.contains("closed_loop")) << run.at("detector");
    EXPECT_FALSE(run.contains("step_ms")) << run.at("detector");
  }
}

class ReproduceCommand : public ClosedLoopCommand {};

void expect_driven(const json& run) {
  EXPECT_EQ(run.at("status"), "ok") << run.at("detector") << run.at("message");
  EXPECT_EQ(run.at("closed_loop").at("error"), "") << run.at("detector");
  EXPECT_EQ(run.at("closed_loop").at("steps"), 8) << "two steps per frame";
  EXPECT_EQ(run.at("step_ms").at("steps"), 8) << run.at("detector");
  EXPECT_EQ(run.at("step_ms").at("repeats"), 1) << run.at("detector");
}

void expect_teapot(const json& scene) {
  EXPECT_EQ(scene.at("scene"), "teapot");
  EXPECT_EQ(scene.at("frames"), 4);
  EXPECT_EQ(scene.at("counts").at("triangles").at("ours"), 12800.0);
  EXPECT_EQ(scene.at("counts").at("triangles").at("paper"), 12800.0);
  const json& row = scene.at("ratios").at(1);
  EXPECT_EQ(row.at("paper_reports").at("table"), "Table 3");
  for (const char* reading : {"safe", "paper", "exact"}) {
    ASSERT_FALSE(row.at(reading).is_null()) << reading;
    EXPECT_GT(row.at(reading).at("test").at("ratio"), 0.0) << reading;
  }
  EXPECT_EQ(row.at("safe").at("same_contacts"), true);
}

TEST_F(ReproduceCommand, OfOneSceneWritesItsTablesBesideThePapers) {
  if (!test::data_installed()) GTEST_SKIP() << "install libcgal-demo and povray-examples";
  const json results = run({"reproduce", "paper-teapot", "--frames", "4", "--repeat", "1"});
  EXPECT_EQ(names_in(out()), test::run_files({"reproduction.json", "reproduction.md"}));
  EXPECT_EQ(results.at("runs").size(), 13u) << "the detectors of the suite paper";
  for (const json& run : results.at("runs")) expect_driven(run);

  const json reproduction = json::parse(text_of(out() / "reproduction.json"));
  EXPECT_EQ(reproduction.at("schema"), "contactcheck-reproduction/1");
  ASSERT_EQ(reproduction.at("scenes").size(), 1u) << "the others were not run";
  expect_teapot(reproduction.at("scenes").at(0));
  EXPECT_EQ(reproduction.at("means").at("scenes"), 1);
  EXPECT_GT(reproduction.at("paper").at("findings").size(), 20u);

  const std::string markdown = text_of(out() / "reproduction.md");
  EXPECT_THAT(markdown, HasSubstr("\n## teapot\n"));
  EXPECT_THAT(markdown, HasSubstr("| triangles | 12800 | 12800 | +0.00 % |\n"));
  EXPECT_THAT(markdown, HasSubstr("\n## What the paper's own numbers say\n"));
  EXPECT_THAT(text_of(out() / "report.md"), HasSubstr("## paper-teapot"));
  EXPECT_EQ(last_.err, "");
  for (const char* file : {"reproduction.md", "reproduction.json", "report.md"})
    EXPECT_THAT(last_.out, HasSubstr((out() / file).string()));
}

}  // namespace
}  // namespace contactcheck::cli
