// Whole runs of the built program on a scene of two boxes.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <set>

#include "core/lazy/kernels.h"
#include "tests/reference/cli/program.h"
#include "tests/reference/cli/run_files.h"
#include "tests/reference/cli/tiny_scene.h"
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
using test::tiny_scene;
using testing::ElementsAre;
using testing::HasSubstr;

std::map<std::string, std::string> hashes_by_detector(const json& results) {
  std::map<std::string, std::string> out;
  for (const json& run : results.at("runs"))
    out[run.at("detector")] = run.at("contact_hash").get<std::string>();
  return out;
}

// Of lists of contacts; each holds as many pairs as it says.
std::size_t sum_of(const std::vector<json>& lists) {
  std::size_t sum = 0;
  for (const json& list : lists) {
    EXPECT_EQ(list.at("pairs").size(), 4 * list.at("count").get<std::size_t>());
    sum += list.at("count").get<std::size_t>();
  }
  return sum;
}

json counts_by_frame(const json& detector, const char* kind) {
  std::vector<std::size_t> counts(5, 0);
  for (const json& frame : detector.at("frames"))
    counts.at(frame.at("frame")) = frame.at(kind).at("count");
  return counts;
}

class RunCommand : public testing::Test {
 protected:
  RunCommand() { scene_ = scratch_.write("tiny.json", tiny_scene()); }

  // Runs into a folder of this name; expects it to end well and to satisfy the schema.
  json run(const std::string& name, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "run");
    arguments.insert(arguments.end(), {"--out", (scratch_.folder() / name).string()});
    last_ = contactcheck_program(arguments);
    EXPECT_EQ(last_.exit_code, 0) << last_.err;
    const fs::path file = scratch_.folder() / name / "results.json";
    const Outcome valid = test::run_program(
        CONTACTCHECK_PYTHON3, {"-B", CONTACTCHECK_VALIDATOR, "--described", file.string()});
    EXPECT_EQ(valid.exit_code, 0) << valid.out << valid.err;
    return json::parse(text_of(file));
  }

  Scratch scratch_;
  fs::path scene_;
  Outcome last_;
};

// It ran the suite `default`.
TEST(RunExplain, AloneSaysWhatTheColumnsMeanAndRunsNothing) {
  const Outcome outcome = contactcheck_program({"run", "--explain"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("  recall               hit / truth, cut, not rounded\n"),
                    HasSubstr("  slowest family       ms a case of")));
  EXPECT_EQ(outcome.err, "");
}

TEST_F(RunCommand, WritesResultsReportRecordingAndNothingElse) {
  const json results = run("out", {scene_, "--no-timing"});
  const fs::path out = scratch_.folder() / "out";
  EXPECT_EQ(names_in(out), test::run_files({"plots"}));
  EXPECT_THAT(names_in(out / "recordings"), ElementsAre("tiny.ccr"));
  EXPECT_THAT(text_of(out / "report.md"), HasSubstr("## tiny"));
  EXPECT_THAT(last_.out, HasSubstr("results.json"));
  std::set<std::string> cases;
  for (const json& d : results.at("disagreements")) cases.insert(d.at("case"));
  std::set<std::string> files;
  for (const std::string& name : names_in(out / "cases")) files.insert("cases/" + name);
  EXPECT_EQ(cases, files);
  for (const std::string& file : files) EXPECT_TRUE(json::accept(text_of(out / file))) << file;
}

// What the report's 3D view shows is what the judge has counted.
TEST_F(RunCommand, ContactsOneByOneAddUpToTheCountsOfTheResults) {
  const json results = run("out", {scene_, "--no-timing"});
  const json& scene = results.at("scenes").at(0);
  const fs::path file = scratch_.folder() / "out" / scene.at("contacts").get<std::string>();
  EXPECT_EQ(file, scratch_.folder() / "out" / "contacts" / "tiny.json");
  const json contacts = json::parse(text_of(file));
  EXPECT_EQ(contacts.at("schema"), "contactcheck-contacts/1");
  EXPECT_EQ(sum_of(contacts.at("truth").get<std::vector<json>>()),
            scene.at("truth").at("triangle"));
  ASSERT_EQ(contacts.at("detectors").size(), results.at("runs").size());
  std::size_t differences = 0;
  for (std::size_t i = 0; i < results.at("runs").size(); ++i) {
    const json& run = results.at("runs").at(i);
    const json& detector = contacts.at("detectors").at(i);
    EXPECT_EQ(detector.at("detector"), run.at("detector"));
    EXPECT_EQ(detector.at("level"), run.at("per_frame").at("level"));
    for (const char* kind : {"missed", "spurious"}) {
      EXPECT_EQ(counts_by_frame(detector, kind), run.at("per_frame").at(kind))
          << detector.at("detector") << " " << kind;
      for (const json& frame : detector.at("frames")) differences += sum_of({frame.at(kind)});
    }
  }
  EXPECT_GT(differences, 0u) << "a scene in which nobody errs shows nothing";
}

// The suites say which detectors run where none is named, and nothing else.
TEST_F(RunCommand, OfFilesAndNamedDetectorsNeedsNoFixtures) {
  const fs::path mesh = scratch_.write("t.off",
                                       "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                                       "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  const test::Environment none("CONTACTCHECK_FIXTURES", (scratch_.folder() / "none").string());
  const Outcome run = contactcheck_program(
      {"run", scene_, "--mesh", mesh, "--mesh", mesh, "--pairs", "600", "--frames", "5",
       "--no-timing", "--detector", "fcl-aabb", "--out", scratch_.folder() / "out"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const json results = json::parse(text_of(scratch_.folder() / "out/results.json"));
  std::vector<std::string> scenes;
  for (const json& row : results.at("runs")) scenes.push_back(row.at("scene"));
  EXPECT_THAT(scenes, ElementsAre("t-t-approach", "tiny", "random-pairs"));
}

TEST_F(RunCommand, FamiliesHaveContactsToShowAndRandomPairsNone) {
  const json results =
      run("out", {"hard-boxes-gap", "--pairs", "600", "--no-timing", "--detector", "ffd-grid"});
  EXPECT_THAT(names_in(scratch_.folder() / "out" / "contacts"), ElementsAre("hard-boxes-gap.json"));
  const json contacts =
      json::parse(text_of(scratch_.folder() / "out" / "contacts" / "hard-boxes-gap.json"));
  std::vector<json> spurious;
  for (const json& frame : contacts.at("detectors").at(0).at("frames"))
    spurious.push_back(frame.at("spurious"));
  EXPECT_GT(sum_of(spurious), 0u);
  EXPECT_EQ(sum_of(spurious),
            results.at("runs").at(0).at("levels").at("cell").at("spurious").get<std::size_t>());
  for (const json& scene : results.at("scenes"))
    EXPECT_EQ(scene.contains("contacts"), !scene.contains("pairs")) << scene.at("id");
}

// Episodes, distances and times belong to motions.
TEST_F(RunCommand, SeparationIsZeroInContactFramesAlone) {
  const json results =
      run("out", {scene_, "hard-boxes-gap", "--no-timing", "--detector", "ffd-grid"});
  const json& scene = results.at("scenes").at(0);
  const auto separation = scene.at("separation").get<std::vector<double>>();
  ASSERT_EQ(separation.size(), 5u);
  EXPECT_EQ(std::count(separation.begin(), separation.end(), 0.0), scene.at("contact_frames"));
  EXPECT_NEAR(separation.front(), 0.3, 1e-8) << "the boxes are 0.3 m apart along x at first";
  EXPECT_FALSE(results.at("scenes").at(1).contains("separation"));
}

TEST_F(RunCommand, RandomPairsAloneAreOneSceneThatNamesCountAndSeed) {
  const json results =
      run("out", {"--pairs", "700", "--seed", "5", "--no-timing", "--detector", "ffd-lazy",
                  "--detector", "ffd-aabb-sphere2+tri", "--detector", "fcl-aabb"});
  ASSERT_EQ(results.at("scenes").size(), 1u);
  const json& scene = results.at("scenes").at(0);
  EXPECT_EQ(scene.at("id"), "random-pairs");
  EXPECT_EQ(scene.at("pairs").at("count"), 700);
  EXPECT_EQ(scene.at("pairs").at("seed"), 5);
  EXPECT_EQ(scene.at("pairs").at("rational").at("checked"), 700);
  EXPECT_EQ(scene.at("pairs").at("rational").at("oracle_wrong"), 0);
  for (std::size_t exact : {0, 1}) {
    const json& level = results.at("runs").at(exact).at("levels").at("triangle");
    EXPECT_EQ(level.at("truth"), scene.at("pairs").at("touching"));
    EXPECT_EQ(level.at("missed"), 0);
    EXPECT_EQ(level.at("spurious"), 0);
  }
  EXPECT_THAT(names_in(scratch_.folder() / "out" / "recordings"), ElementsAre());
  EXPECT_THAT(last_.out, HasSubstr("700 pairs, seed 5, "));
  EXPECT_THAT(text_of(scratch_.folder() / "out" / "report.md"), HasSubstr("| mixed-scale |"));
}

TEST_F(RunCommand, RandomPairsComeBesideTheTargetsAndAreTimedOnAFewFrames) {
  const json results = run("out", {scene_, "--pairs", "20000", "--detector", "ffd-lazy"});
  ASSERT_EQ(results.at("scenes").size(), 2u);
  const json& run = results.at("runs").at(1);
  EXPECT_EQ(run.at("scene"), "random-pairs");
  EXPECT_EQ(run.at("frames"), 35);
  EXPECT_GT(run.at("time_ms").at("timed_frames"), 0);
  EXPECT_EQ(results.at("scenes").at(1).at("pairs").at("seed"), 1);
}

TEST_F(RunCommand, ExactDetectorsAreExactAndTheResultsSayWhatWasThere) {
  const json results = run("out", {scene_, "--no-timing"});
  const json& scene = results.at("scenes").at(0);
  EXPECT_EQ(scene.at("frames"), 5);
  EXPECT_GT(scene.at("contact_frames"), 0);
  EXPECT_GT(scene.at("truth").at("triangle"), 0);
  std::size_t exact = 0;
  for (const json& run : results.at("runs")) {
    EXPECT_EQ(run.at("status"), "ok") << run.at("detector") << run.at("message");
    EXPECT_EQ(run.at("recording"), "recordings/tiny.ccr");
    if (!run.at("semantics").at("exact").get<bool>() && run.at("detector") != "fcl-aabb") continue;
    ++exact;
    EXPECT_EQ(run.at("levels").at("triangle").at("recall"), 1.0) << run.at("detector");
    EXPECT_EQ(run.at("levels").at("triangle").at("spurious"), 0) << run.at("detector");
  }
  EXPECT_GE(exact, 6u) << "fcl-aabb and the five with +tri";
}

TEST_F(RunCommand, TimedRunHasTimesAndSpeedUps) {
  const json results = run("out", {scene_, "--detector", "fcl-aabb", "--detector",
                                   "ffd-aabb-sphere2+tri", "--processes", "1", "--quiet"});
  EXPECT_EQ(last_.err, "");
  ASSERT_EQ(results.at("runs").size(), 2u);
  for (const json& run : results.at("runs")) {
    EXPECT_EQ(run.at("time_ms").at("question"), "triangles");
    EXPECT_EQ(run.at("time_ms").at("passes"), 1);
    EXPECT_EQ(run.at("time_ms").at("timed_frames"), run.at("frames"));
    for (const char* regime : {"playback", "cold"})
      EXPECT_GT(run.at("time_ms").at(regime).at("frame"), 0.0);
    EXPECT_EQ(run.at("per_frame").at("frame_ms").size(), 5u);
  }
  const json& speedup = results.at("runs").at(1).at("speedup");
  EXPECT_GT(speedup.at("triangles").at("fcl-aabb").at("playback").at("ratio"), 0.0);
  EXPECT_TRUE(speedup.contains("body"));
  EXPECT_FALSE(speedup.at("triangles").contains("fcl-obbrss")) << "it was not run";
  const json& own = results.at("runs").at(0).at("speedup").at("triangles").at("fcl-aabb");
  EXPECT_EQ(own.at("playback").at("low"), 1.0);
  EXPECT_EQ(own.at("cold").at("high"), 1.0);
  EXPECT_EQ(own.at("interval"), "range");
  EXPECT_EQ(results.at("timing").at("processes"), 1);
  EXPECT_EQ(results.at("scenes").at(0).at("cold_frames").size(), 5u);
}

TEST_F(RunCommand, PassesAreAsManyAsProcesses) {
  const json results = run("out", {scene_, "--detector", "fcl-aabb", "--detector", "embree",
                                   "--processes", "5", "--seed", "7", "--quiet"});
  for (const json& row : results.at("runs")) {
    EXPECT_EQ(row.at("time_ms").at("passes"), 5);
    const json& speedup = row.at("speedup").at("triangles").at("fcl-aabb");
    EXPECT_EQ(speedup.at("passes"), 5);
    EXPECT_EQ(speedup.at("interval"), "95 %");
  }
  EXPECT_EQ(results.at("timing").at("one_pass_beyond"), 0) << "as many as were asked for";
  EXPECT_EQ(results.at("timing").at("seed"), 7);
}

TEST_F(RunCommand, RecordingReplaysToTheSameContacts) {
  const json first = run("out", {scene_, "--no-timing", "--quiet"});
  const fs::path recording = scratch_.folder() / "out" / "recordings" / "tiny.ccr";
  const json again = run("again", {recording, "--no-timing", "--quiet"});
  EXPECT_GE(hashes_by_detector(first).size(), 13u);
  EXPECT_EQ(hashes_by_detector(first), hashes_by_detector(again));
  EXPECT_EQ(text_of(recording), text_of(scratch_.folder() / "again" / "recordings" / "tiny.ccr"));
}

TEST_F(RunCommand, ReplayIntoItsOwnFolderKeepsTheRecording) {
  run("out", {scene_, "--no-timing", "--quiet", "--detector", "fcl-aabb"});
  const fs::path recording = scratch_.folder() / "out" / "recordings" / "tiny.ccr";
  const std::string before = text_of(recording);
  run("out", {recording, "--no-timing", "--quiet", "--detector", "fcl-aabb"});
  EXPECT_EQ(text_of(recording), before);
}

TEST_F(RunCommand, RecordingGivesItsFirstFrames) {
  const json whole = run("out", {scene_, "--no-timing", "--quiet", "--detector", "fcl-aabb"});
  const std::string recording = scratch_.folder() / "out" / "recordings" / "tiny.ccr";
  const json first = run(
      "again", {recording, "--frames", "3", "--no-timing", "--quiet", "--detector", "fcl-aabb"});
  EXPECT_EQ(first.at("scenes").at(0).at("frames"), 3);
  const json& all = whole.at("runs").at(0).at("per_frame").at("truth");
  EXPECT_EQ(first.at("runs").at(0).at("per_frame").at("truth"),
            json(std::vector<json>(all.begin(), all.begin() + 3)));
  const Outcome more = contactcheck_program(
      {"run", recording, "--frames", "6", "--out", scratch_.folder() / "more"});
  EXPECT_EQ(more.exit_code, 2);
  EXPECT_EQ(more.err, "contactcheck: --frames: recording \"" + recording + "\" has 5 frames\n");
  EXPECT_FALSE(fs::exists(scratch_.folder() / "more"));
  const Outcome same =
      contactcheck_program({"run", recording, "--frames", "3", "--out", scratch_.folder() / "out"});
  EXPECT_EQ(same.exit_code, 2);
  EXPECT_THAT(same.err, HasSubstr("would lose its other frames; name another --out"));
}

TEST_F(RunCommand, TwiceGivesTheSameContacts) {
  EXPECT_EQ(hashes_by_detector(run("one", {scene_, "--no-timing", "--quiet"})),
            hashes_by_detector(run("two", {scene_, "--no-timing", "--quiet"})));
}

TEST_F(RunCommand, DetectorNamedTwiceRunsOnce) {
  const json results =
      run("out", {scene_, "--no-timing", "--quiet", "--detector", "ffd-aabb", "--detector",
                  "ffd-aabb:bounds=paper", "--detector", "ffd-aabb"});
  ASSERT_EQ(results.at("runs").size(), 1u);
  EXPECT_EQ(results.at("runs").at(0).at("detector"), "ffd-aabb");
}

TEST_F(RunCommand, ThreadsAndInstructionSetsChangeNoContact) {
  std::vector<std::string> arguments = {scene_,       "--no-timing", "--quiet",  "--threads",
                                        "3",          "--detector",  "ffd-lazy", "--detector",
                                        "full-refit", "--detector",  "fcl-aabb"};
  for (const std::string& isa : lazy_isas()) arguments.insert(arguments.end(), {"--isa", isa});
  const json results = run("out", arguments);
  const std::map<std::string, std::string> hashes = hashes_by_detector(results);
  EXPECT_EQ(hashes.size(), 2 * lazy_isas().size() + 1);
  for (const auto& [detector, hash] : hashes) {
    EXPECT_EQ(hash, hashes.at("fcl-aabb")) << detector;
    EXPECT_TRUE(detector == "fcl-aabb" || detector.ends_with(",threads=3")) << detector;
  }
  const json& counters = results.at("runs").at(0).at("counters");
  EXPECT_GT(counters.at("triangle_tests"), 0);
  EXPECT_GT(counters.at("blocks_bounded"), 0);
}

TEST_F(RunCommand, OptionsInANameStandAgainstThreadsAndIsa) {
  const json results = run("out", {scene_, "--no-timing", "--quiet", "--threads", "3", "--isa",
                                   lazy_isas().front(), "--detector", "ffd-lazy:threads=2"});
  EXPECT_EQ(results.at("runs").at(0).at("detector"),
            "ffd-lazy:isa=" + lazy_isas().front() + ",threads=2");
}

TEST_F(RunCommand, InstructionSetsThatNobodyUsesAreRefused) {
  const Outcome outcome = contactcheck_program(
      {"run", scene_, "--detector", "fcl-aabb", "--isa", "best", "--out", scratch_.folder() / "o"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--isa best: no detector of this run"));
}

TEST_F(RunCommand, InstructionSetOfAnotherMachineIsAbsent) {
  const std::vector<std::string> here = lazy_isas();
  for (const std::string isa : {"AVX3", "NEON"}) {
    if (std::find(here.begin(), here.end(), isa) != here.end()) continue;
    const json results =
        run("out", {scene_, "--no-timing", "--detector", "ffd-lazy", "--isa", isa});
    EXPECT_EQ(results.at("runs").at(0).at("status"), "absent");
    EXPECT_THAT(results.at("runs").at(0).at("message").get<std::string>(), HasSubstr(isa));
    EXPECT_THAT(last_.out, HasSubstr("absent: ffd-lazy:isa=" + isa));
  }
}

TEST_F(RunCommand, FramesReplaceThoseOfTheScene) {
  const json results =
      run("out", {scene_, "--no-timing", "--quiet", "--detector", "fcl-aabb", "--frames", "7"});
  EXPECT_EQ(results.at("scenes").at(0).at("frames"), 7);
  EXPECT_EQ(results.at("runs").at(0).at("frames"), 7);
  EXPECT_EQ(results.at("runs").at(0).at("per_frame").at("truth").size(), 7u);
  EXPECT_DOUBLE_EQ(results.at("scenes").at(0).at("time_step"), 1.0 / 7.0);
}

TEST_F(RunCommand, OnlyCasesOfEarlierRunsAreRemoved) {
  const fs::path cases = scratch_.folder() / "out" / "cases";
  scratch_.write("out/cases/9999.json", "{}");
  scratch_.write("out/cases/notes.json", "mine");
  scratch_.write("out/cases/2024/0001.json", "mine");
  run("out", {scene_, "--no-timing", "--quiet", "--detector", "fcl-aabb"});
  EXPECT_THAT(names_in(cases), ElementsAre("2024", "notes.json"));
}

TEST_F(RunCommand, DetectorThatNeedsALatticeIsRefusedWithoutOne) {
  const fs::path bare = scratch_.write("bare.json", R"({"id": "bare", "frames": 2, "duration": 1,
    "levels": ["body", "cell", "triangle"], "bodies": [
    {"name": "a", "mesh": {"shape": "box"}},
    {"name": "b", "mesh": {"shape": "box", "center": [0.9, 0.1, 0.1]}}]})");
  const json results = run("out", {bare, "--detector", "ffd-aabb", "--detector", "fcl-aabb"});
  EXPECT_EQ(results.at("runs").at(0).at("status"), "refused");
  EXPECT_THAT(results.at("runs").at(0).at("message").get<std::string>(), HasSubstr("\"a\""));
  EXPECT_FALSE(results.at("runs").at(0).contains("levels"));
  EXPECT_EQ(results.at("runs").at(1).at("status"), "ok");
  EXPECT_THAT(last_.out, HasSubstr("refused"));
}

TEST_F(RunCommand, OpenBodiesAreNotJudgedWhereInsideIsNotDefined) {
  const fs::path file = scratch_.write("open.json", R"({"id": "open", "frames": 1, "duration": 1,
    "levels": ["triangle", "vertex", "containment"], "bodies": [
    {"name": "a", "mesh": {"file": "open.obj"}},
    {"name": "b", "mesh": {"shape": "box", "center": [0.5, 0.1, 0.1]}}]})");
  scratch_.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const json results = run("out", {file, "--no-timing", "--quiet", "--detector", "fcl-aabb"});
  const json& truth = results.at("scenes").at(0).at("truth");
  EXPECT_EQ(truth.at("vertex"), "not judged: open");
  EXPECT_EQ(truth.at("containment"), "not judged: open");
  EXPECT_GT(truth.at("triangle"), 0);
}

TEST_F(RunCommand, ScenesRunInTheOrderGivenWithRunningCaseNumbers) {
  const fs::path second = scratch_.write("second.json", tiny_scene("second", "3"));
  const json results = run("out", {second, scene_, "--no-timing", "--detector", "ffd-aabb"});
  EXPECT_EQ(results.at("scenes").at(0).at("id"), "second");
  EXPECT_EQ(results.at("scenes").at(1).at("id"), "tiny");
  std::size_t number = 0;
  for (const json& d : results.at("disagreements")) {
    char name[32];
    std::snprintf(name, sizeof name, "cases/%04zu.json", ++number);
    EXPECT_EQ(d.at("case"), name);
    EXPECT_EQ(json::parse(text_of(scratch_.folder() / "out" / name)).at("scene"), d.at("scene"));
  }
  EXPECT_THAT(last_.err, HasSubstr("scene 1 of 2: second\n"));
  EXPECT_THAT(last_.out, HasSubstr("all scenes"));
}

}  // namespace
}  // namespace contactcheck::cli
