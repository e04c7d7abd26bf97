// The worked examples of detectors from outside, through the whole program.
#include <gmock/gmock.h>

#include <filesystem>

#include "reference/text/shell_word.h"
#include "tests/reference/plugin/plugin_run.h"
#include "tests/support/files.h"

namespace contactcheck {
namespace {

using nlohmann::json;
using test::Outcome;
using test::PluginRun;

std::string c_library() { return CONTACTCHECK_C_EXAMPLE; }
std::string python_command() {
  return text::in_shell(CONTACTCHECK_PYTHON3) + " -B " +
         text::in_shell(CONTACTCHECK_PYTHON_EXAMPLE);
}

void expect_exact(const json& row) {
  ASSERT_EQ(row.at("status"), "ok") << row.at("message");
  const json& level = row.at("levels").at("triangle");
  EXPECT_GT(level.at("truth"), 0);
  EXPECT_EQ(level.at("missed"), 0);
  EXPECT_EQ(level.at("spurious"), 0);
}

TEST(OwnDetectors, FromOutsideAnswerAsFclDoes) {
  PluginRun run(
      {"--detector", c_library(), "--detector-cmd", python_command(), "--detector", "fcl-aabb"});
  EXPECT_EQ(run.outcome().exit_code, 0) << run.outcome().err;
  EXPECT_EQ(run.schema_errors(), "");
  for (const char* detector : {"c-sweep", "python-sweep"}) {
    const json row = run.row(detector);
    expect_exact(row);
    EXPECT_EQ(row.at("contact_hash"), run.row("fcl-aabb").at("contact_hash")) << detector;
    EXPECT_EQ(row.at("notes"), json::array()) << detector;
  }
  EXPECT_FALSE(run.row("c-sweep").at("semantics").at("exact"));
  EXPECT_TRUE(run.row("python-sweep").at("semantics").at("exact"));
}

TEST(OwnDetectors, FromOutsideAreNamedInTheResults) {
  PluginRun run({"--detector", c_library() + ":axis=z", "--detector-cmd", python_command()});
  EXPECT_EQ(run.row("c-sweep:axis=z").at("options"), json({{"axis", "z"}}));
  EXPECT_THAT(run.results().at("command").get<std::string>(),
              testing::HasSubstr("--detector-cmd " + text::in_shell(python_command())))
      << "to be run again as it stands";
  const json plugins = run.results().at("plugins");
  ASSERT_EQ(plugins.size(), 2u);
  EXPECT_EQ(plugins[0].at("detector"), "python-sweep");
  EXPECT_EQ(plugins[0].at("kind"), "command");
  EXPECT_EQ(plugins[0].at("source"), python_command());
  EXPECT_EQ(plugins[1].at("detector"), "c-sweep");
  EXPECT_EQ(plugins[1].at("source"), std::filesystem::path(c_library()).filename().string());
  EXPECT_EQ(plugins[1].at("version"), "1.0");
}

TEST(OwnDetectors, InCTellOfTheirStagesAndCounts) {
  PluginRun run({"--detector", c_library()});
  const json row = run.row("c-sweep");
  ASSERT_EQ(row.at("stages").size(), 1u);
  const json boxes = row.at("stages")[0];
  EXPECT_EQ(boxes.at("name"), "boxes");
  EXPECT_EQ(boxes.at("missed"), 0);
  EXPECT_GE(boxes.at("out"), row.at("levels").at("triangle").at("truth"));
  EXPECT_GT(boxes.at("in"), boxes.at("out"));
  EXPECT_EQ(row.at("counters").at("pairs_swept"), boxes.at("in"));
  EXPECT_EQ(row.at("counters").at("triangle_pairs_tested"), boxes.at("out"));
}

TEST(OwnDetectors, OfALibraryTwiceAreTwoRows) {
  PluginRun run({"--detector", c_library() + ":axis=y", "--detector", c_library()});
  expect_exact(run.row("c-sweep:axis=y"));
  expect_exact(run.row("c-sweep"));
  EXPECT_EQ(run.results().at("plugins").size(), 1u);
}

TEST(OwnDetectors, AreTimedInEveryProcessBesideTheirOwnClock) {
  PluginRun run(
      {"--detector", c_library(), "--detector-cmd", python_command(), "--detector", "fcl-aabb"},
      {"--processes", "2", "--threads", "2"});
  EXPECT_EQ(run.outcome().exit_code, 0) << run.outcome().err;
  EXPECT_EQ(run.schema_errors(), "");
  for (const char* detector : {"c-sweep", "python-sweep"}) {
    const json row = run.row(detector);
    EXPECT_EQ(row.at("time_ms").at("passes"), 2) << detector;
    EXPECT_TRUE(row.at("speedup").at("triangles").contains("fcl-aabb")) << detector;
  }
  for (const char* part : {"playback", "cold"}) {
    for (const char* detector : {"c-sweep", "python-sweep"}) {
      const json times = run.row(detector).at("time_ms").at(part);
      EXPECT_GT(times.at("self_reported").get<double>(), 0.0) << detector;
    }
    const json times = run.row("python-sweep").at("time_ms").at(part);
    const double ours = times.at("update").get<double>() + times.at("query").get<double>();
    EXPECT_LT(times.at("self_reported").get<double>(), ours) << "ours has the pipe in it";
    EXPECT_FALSE(run.row("fcl-aabb").at("time_ms").at(part).contains("self_reported"));
  }
}

TEST(OwnDetectors, InPythonAnswerForBodiesThatTouchThemselves) {
  const test::Scratch scratch;
  const std::filesystem::path out = scratch.folder() / "out";
  const Outcome outcome = test::contactcheck_program(
      {"run", "hard-self-layers", "hard-self-crossing-scale", "hard-self-t-junction",
       "hard-self-sectors-turned", "hard-self-corner-segment", "hard-self-repeated-index",
       "hard-self-point", "hard-self-hinge-turned", "hard-self-edge-segments",
       "hard-self-edge-needle", "hard-self-duplicates", "--detector-cmd", python_command(),
       "--no-timing", "--out", out.string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json results = json::parse(test::text_of(out / "results.json"));
  ASSERT_EQ(results.at("runs").size(), 11u);
  for (const json& row : results.at("runs")) {
    ASSERT_EQ(row.at("status"), "ok") << row.at("message");
    ASSERT_EQ(row.at("levels").size(), 1u) << row.at("scene");
    for (const auto& [name, level] : row.at("levels").items()) {
      EXPECT_EQ(level.at("missed"), 0) << row.at("scene");
      EXPECT_EQ(level.at("spurious"), 0) << row.at("scene");
    }
  }
}

// Touching, degenerate and coplanar triangles, and pairs that rounding gets wrong: the example in
// Python claims them all.
TEST(OwnDetectors, InPythonAreExactOnHardCases) {
  const test::Scratch scratch;
  const std::filesystem::path out = scratch.folder() / "out";
  const Outcome outcome = test::contactcheck_program(
      {"run", "hard-point", "hard-segment", "hard-segment-in-plane", "hard-two-segments",
       "hard-two-segments-plane", "hard-vertex-vertex", "hard-coplanar-slide", "hard-identical",
       "--pairs", "300", "--detector-cmd", python_command(), "--no-timing", "--out", out.string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json results = json::parse(test::text_of(out / "results.json"));
  EXPECT_EQ(results.at("runs").size(), 9u);
  for (const json& row : results.at("runs")) {
    ASSERT_EQ(row.at("status"), "ok") << row.at("message");
    EXPECT_EQ(row.at("levels").at("triangle").at("missed"), 0) << row.at("scene");
    EXPECT_EQ(row.at("levels").at("triangle").at("spurious"), 0) << row.at("scene");
  }
}

TEST(OwnDetectors, InCppAreInTheCatalogueOfTheirProgram) {
  const Outcome list = test::run_program(CONTACTCHECK_CPP_EXAMPLE, {"list", "--detectors"});
  EXPECT_THAT(list.out, testing::HasSubstr("\ncpp-sweep\n"));
}

// Simulated bodies that fall on one another, driven by detectors from outside.
constexpr const char* kFall = R"({
  "id": "fall", "title": "A box falls onto another", "frames": 4,
  "simulation": {"every": 6, "ground": {}, "driver": "ffd-aabb+tri"},
  "levels": ["body", "triangle"],
  "bodies": [
    {"name": "below", "mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [2, 2, 2]},
     "motion": {"position": [0, 0.6, 0]}, "material": {"model": "mass-spring", "mass": 1}},
    {"name": "above", "mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [2, 2, 2]},
     "motion": {"position": [0.1, 1.7, 0.2]}, "material": {"model": "mass-spring", "mass": 1}}]
})";

TEST(OwnDetectors, DriveSimulations) {
  const test::Scratch scratch;
  const std::string scene = scratch.write("fall.json", kFall).string();
  const std::string out = (scratch.folder() / "out").string();
  const Outcome outcome =
      test::contactcheck_program({"run", scene, "--closed-loop", "--processes", "1", "--detector",
                                  c_library(), "--detector-cmd", python_command(), "--out", out});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json results = json::parse(test::text_of(out + "/results.json"));
  for (const json& row : results.at("runs")) {
    ASSERT_TRUE(row.contains("closed_loop")) << row.at("detector") << row.at("message");
    EXPECT_EQ(row.at("closed_loop").at("error"), "") << row.at("detector");
    EXPECT_TRUE(row.contains("step_ms")) << row.at("detector");
  }
}

Outcome ab(const std::string& base, const std::string& head, const std::string& out) {
  return test::contactcheck_program({"ab", base, head, "hard-vertex-face", "--rounds", "5",
                                     "--floor-us", "1e9", "--quiet", "--out", out});
}

TEST(OwnDetectors, OfTwoBuildsOfALibraryAreComparedInTurns) {
  const test::Scratch scratch;
  const std::string out = (scratch.folder() / "ab").string();
  const Outcome same = ab(c_library(), c_library(), out);
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_THAT(same.out, testing::HasSubstr("PASS: answers are equal, 1 time is within the limit."));
  const Outcome other = ab(c_library(), c_library() + ":axis=y", out);
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, testing::HasSubstr("ab compares two builds of one detector"));
  const Outcome mixed = ab(CONTACTCHECK_PROGRAM, c_library(), out);
  EXPECT_EQ(mixed.exit_code, 2);
  EXPECT_THAT(mixed.err, testing::HasSubstr("ab compares two of a kind"));
}

TEST(OwnDetectors, OfTwoCommandsAreComparedInTurns) {
  const test::Scratch scratch;
  const std::string out = (scratch.folder() / "ab").string();
  const Outcome same = ab(python_command(), "env " + python_command(), out);
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_THAT(same.out, testing::HasSubstr("PASS: answers are equal, 1 time is within the limit."));
  const Outcome mixed = ab(python_command(), c_library(), out);
  EXPECT_EQ(mixed.exit_code, 2);
  EXPECT_THAT(mixed.err, testing::HasSubstr("is a command and head"));
  EXPECT_THAT(mixed.err, testing::HasSubstr("is a library; ab compares two of a kind"));
}

TEST(OwnDetectors, InCppAreJudgedByTheirProgram) {
  PluginRun run({"--detector", "cpp-sweep:axis=y"}, {"--no-timing"}, CONTACTCHECK_CPP_EXAMPLE);
  EXPECT_EQ(run.outcome().exit_code, 0) << run.outcome().err;
  expect_exact(run.row("cpp-sweep:axis=y"));
}

}  // namespace
}  // namespace contactcheck
