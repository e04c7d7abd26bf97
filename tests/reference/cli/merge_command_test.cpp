// Runs in shards: what merge makes of them, and what it refuses.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "tests/reference/cli/program.h"
#include "tests/reference/cli/refusal.h"
#include "tests/reference/cli/run_files.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using test::contactcheck_program;
using test::names_in;
using test::Outcome;
using test::text_of;
using test::tiny_scene;
using test::Words;
using testing::ElementsAre;
using testing::HasSubstr;

// Everything that a clock or an address has a say in.
void drop_times(Json& node) {
  if (!node.is_structured()) return;
  if (node.is_object())
    for (const char* key : {"time_ms", "time_ms_other_questions", "speedup", "frame_ms",
                            "memory_bytes", "prepared_bytes", "measured", "low", "high", "met"})
      node.erase(key);
  for (Json& member : node) drop_times(member);
}

Json without_times(Json results) {
  drop_times(results);
  results.erase("command");
  results.erase("merged");
  return results;
}

void expect_same_files(const fs::path& a, const fs::path& b) {
  EXPECT_EQ(names_in(a), names_in(b));
  for (const std::string& name : names_in(a))
    EXPECT_EQ(text_of(a / name), text_of(b / name)) << name;
}

class Shards : public testing::Test {
 protected:
  Shards() { write_scenes(scratch_); }

  static void write_scenes(const test::Scratch& scratch) {
    for (const char* id : {"one", "two", "three", "four", "five"})
      scratch.write(std::string(id) + ".json", tiny_scene(id));
  }

  fs::path dir(const std::string& name) const { return scratch_.folder() / name; }
  Words command(const std::string& out, const Words& more) const {
    Words words = {"run",      "--detector", "fcl-aabb", "--detector",
                   "ffd-grid", "--detector", "ffd-aabb"};
    for (const char* id : {"one", "two", "three", "four", "five"})
      words.push_back(dir(std::string(id) + ".json").string());
    words.insert(words.end(), {"--pairs", "300", "--quiet", "--out", dir(out).string()});
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  Json run(const std::string& out, const Words& more) const {
    return results_of(contactcheck_program(command(out, more)), out);
  }
  Json merge(const Words& parts, const std::string& out) const {
    Words words = {"merge"};
    for (const std::string& part : parts) words.push_back((dir(part) / "results.json").string());
    words.insert(words.end(), {"--out", dir(out).string()});
    return results_of(contactcheck_program(words), out);
  }
  Json results_of(const Outcome& outcome, const std::string& out) const {
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const fs::path file = dir(out) / "results.json";
    const Outcome valid = test::run_program(
        CONTACTCHECK_PYTHON3, {"-B", CONTACTCHECK_VALIDATOR, "--described", file.string()});
    EXPECT_EQ(valid.exit_code, 0) << valid.out << valid.err;
    return Json::parse(text_of(file));
  }
  void expect_same_folders(const std::string& a, const std::string& b) const {
    for (const char* folder : {"cases", "contacts", "plots", "recordings"})
      expect_same_files(dir(a) / folder, dir(b) / folder);
  }

  test::Scratch scratch_;
};

TEST_F(Shards, MergedAreTheResultsOfTheRunInOnePiece) {
  const Json whole = run("whole", {"--no-timing"});
  for (const char* k : {"1", "2", "3"})
    run(std::string("part") + k, {"--no-timing", "--shard", std::string(k) + "/3"});
  const Json merged = merge({"part3", "part1", "part2"}, "out");
  EXPECT_EQ(without_times(merged), without_times(whole));
  EXPECT_EQ(merged.at("runs").size(), 6u * 3u);
  EXPECT_GT(merged.at("disagreements").size(), 5u) << "there are cases to number";
  expect_same_folders("out", "whole");
  EXPECT_THAT(text_of(dir("out") / "report.md"), HasSubstr("Put together from 3 shards"));
  EXPECT_EQ(names_in(dir("out")), test::run_files({"plots"}));
}

TEST_F(Shards, AreNoBaseline) {
  run("part1", {"--no-timing", "--shard", "1/2"});
  const Outcome refused =
      contactcheck_program({"accept", (dir("part1") / "results.json").string(), "--as",
                            (scratch_.folder() / "base.json").string()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("is a shard of a run"));
  EXPECT_FALSE(fs::exists(scratch_.folder() / "base.json"));
}

TEST_F(Shards, ReplayAndReduceWhatWasMerged) {
  run("part1", {"--no-timing", "--shard", "1/2"});
  run("part2", {"--no-timing", "--shard", "2/2"});
  merge({"part1", "part2"}, "out");
  const Outcome reduced = contactcheck_program(
      {"reduce", (dir("out") / "cases" / "0001.json").string(), "--budget", "200"});
  EXPECT_EQ(reduced.exit_code, 0) << reduced.err;
}

TEST_F(Shards, WithTimesAllElseIsTheSame) {
  const Json whole = run("whole", {"--processes", "1"});
  run("part1", {"--processes", "1", "--shard", "1/2"});
  run("part2", {"--processes", "1", "--shard=2/2"});
  const Json merged = merge({"part1", "part2"}, "out");
  EXPECT_EQ(without_times(merged), without_times(whole));
  EXPECT_TRUE(merged.at("runs").at(0).at("time_ms").contains("cold"));
  EXPECT_EQ(names_in(dir("out")), names_in(dir("whole")));
}

// A goal may compare scenes of two shards.
TEST_F(Shards, GoalsAreMeasuredWhenAllIsTogether) {
  const fs::path suite = scratch_.write("goals.json", R"({"id": "goals", "title": "Goals",
    "scenes": ["small-pair", "bunny-touch"], "detectors": ["ffd-lazy"],
    "goals": [{"goal": "one to the other", "scene": "small-pair", "detector": "ffd-lazy",
               "part": "cold", "over_scene": "bunny-touch", "at_most": 1e9}]})");
  for (const std::string k : {"1", "2"}) {
    const Json part = results_of(
        contactcheck_program({"run", suite.string(), "--frames", "3", "--processes", "1", "--quiet",
                              "--shard", k + "/2", "--out", dir("part" + k).string()}),
        "part" + k);
    EXPECT_FALSE(part.contains("goals"));
  }
  const Json goal = merge({"part1", "part2"}, "out").at("goals").at(0);
  EXPECT_EQ(goal.at("goal"), "one to the other");
  EXPECT_EQ(goal.at("over_scene"), "bunny-touch");
  EXPECT_EQ(goal.at("at_most"), 1e9);
  EXPECT_EQ(goal.at("met"), true) << goal;
}

TEST_F(Shards, SayWhichPartTheyAre) {
  run("part2", {"--no-timing", "--shard", "2/3"});
  const Json results = Json::parse(text_of(dir("part2") / "results.json"));
  EXPECT_EQ(results.at("shard").at("index"), 2);
  EXPECT_EQ(results.at("shard").at("of"), 3);
  ASSERT_EQ(results.at("scenes").size(), 2u);
  EXPECT_EQ(results.at("scenes").at(0).at("id"), "two");
  EXPECT_EQ(results.at("scenes").at(1).at("id"), "five");
  EXPECT_THAT(text_of(dir("part2") / "report.md"), HasSubstr("Shard 2 of 3: 2 of the 6 scenes"));
}

TEST_F(Shards, OneIsKilledAndRunAgain) {
  const Json whole = run("whole", {"--no-timing"});
  run("part1", {"--no-timing", "--shard", "1/2"});
  {
    test::RunningProgram program(CONTACTCHECK_PROGRAM,
                                 command("part2", {"--no-timing", "--shard", "2/2"}));
    for (int i = 0; i < 12'000 && !program.has_ended(); ++i) {
      if (fs::exists(dir("part2") / "partial" / "two.partial.json")) break;
      usleep(500);
    }
    program.send(SIGKILL);
    EXPECT_EQ(program.outcome().exit_code, 128 + SIGKILL) << "it had not ended";
  }
  ASSERT_FALSE(fs::exists(dir("part2") / "results.json"));
  const Json part = run("part2", {"--no-timing", "--shard", "2/2", "--resume"});
  EXPECT_THAT(part.at("resumed"), testing::Contains("two"));
  Json merged = merge({"part1", "part2"}, "out");
  EXPECT_EQ(merged.at("resumed"), part.at("resumed"));
  merged.erase("resumed");
  EXPECT_EQ(without_times(merged), without_times(whole));
  expect_same_folders("out", "whole");
}

TEST_F(Shards, MoreThanScenesAreRefused) {
  const Outcome outcome = contactcheck_program(command("out", {"--shard", "1/7"}));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--shard 1/7: this run has 6 scenes"));
  EXPECT_FALSE(fs::exists(dir("out")));
}

// Two shards that belong together.
struct GoodShards {
  GoodShards() {
    scratch.write("one.json", tiny_scene("one"));
    scratch.write("two.json", tiny_scene("two"));
    for (const char* k : {"1", "2"}) {
      const Outcome outcome =
          contactcheck_program({"run", (scratch.folder() / "one.json").string(),
                                (scratch.folder() / "two.json").string(), "--detector", "fcl-aabb",
                                "--detector", "ffd-grid", "--quiet", "--processes", "1", "--shard",
                                std::string(k) + "/2", "--out", (scratch.folder() / k).string()});
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    }
  }
  test::Scratch scratch;
};

// Made once, gone at the end of the program; every test gets a copy.
const test::Scratch& good_shards() {
  static const GoodShards shards;
  return shards.scratch;
}

/// What is done to DIR/2 before DIR/1 and DIR/2 are merged.
struct BadShards {
  std::string name;
  std::function<void(Json&)> change;           ///< its results
  std::function<void(const fs::path&)> spoil;  ///< its folder
  Words files;                                 ///< given in place of both
  Words named;
};
void PrintTo(const BadShards& shards, std::ostream* out) { *out << shards.name; }

class Refused : public testing::TestWithParam<BadShards> {};

TEST_P(Refused, WithOneSentence) {
  const test::Scratch scratch;
  for (const char* part : {"1", "2"})
    fs::copy(good_shards().folder() / part, scratch.folder() / part, fs::copy_options::recursive);
  const fs::path file = scratch.folder() / "2" / "results.json";
  if (GetParam().change) {
    Json results = Json::parse(text_of(file));
    GetParam().change(results);
    std::ofstream(file) << results.dump(1);
  }
  if (GetParam().spoil) GetParam().spoil(scratch.folder() / "2");
  Words words = {"merge"};
  const Words both = {"DIR/1/results.json", "DIR/2/results.json"};
  for (const std::string& given : GetParam().files.empty() ? both : GetParam().files)
    words.push_back(given);
  words.insert(words.end(), {"--out", "DIR/out"});
  test::expect_refused({"", words, GetParam().named}, scratch);
}

BadShards changed(const std::string& name, std::function<void(Json&)> change, Words named) {
  named.emplace_back("DIR/2/results.json");
  return {name, std::move(change), {}, {}, std::move(named)};
}
BadShards spoilt(const std::string& name, std::function<void(const fs::path&)> spoil, Words named) {
  return {name, {}, std::move(spoil), {}, std::move(named)};
}

void append_to(const fs::path& file) { std::ofstream(file, std::ios::app) << "x"; }
void cut(const fs::path& file) { fs::resize_file(file, fs::file_size(file) / 2); }

std::string test_name(const testing::TestParamInfo<BadShards>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(
    OtherRun, Refused,
    testing::Values(
        changed("Version", [](Json& r) { r["version"] = "0.0.1"; }, {"version", "\"0.0.1\""}),
        changed("Build", [](Json& r) { r["shard"]["program"] = "0x1"; }, {"program", "\"0x1\""}),
        changed("Compiler", [](Json& r) { r["machine"]["compiler"] = "other"; },
                {"machine compiler", "\"other\""}),
        changed("Machine", [](Json& r) { r["machine"]["cpu"] = "other"; }, {"machine cpu"}),
        changed("Library", [](Json& r) { r["libraries"]["fcl"] = "9"; }, {"library fcl", "\"9\""}),
        changed("Setting", [](Json& r) { r["shard"]["settings"]["processes"] = 77; },
                {"setting processes is 77", "it is 1"}),
        changed("SettingThatTheOthersLack", [](Json& r) { r["shard"]["settings"]["more"] = 1; },
                {"setting more is 1"}),
        changed("Scene", [](Json& r) { r["shard"]["scenes"][0]["id"] = "other"; },
                {"scene 1 is \"other\"", "\"one\""}),
        changed("MoreScenes",
                [](Json& r) { r["shard"]["scenes"].push_back(r["shard"]["scenes"][0]); },
                {"number of scenes is 3"}),
        changed("Content", [](Json& r) { r["shard"]["scenes"][1]["content"] = "0x2"; },
                {"scene \"two\"", "file or meshes"}),
        changed("Detectors", [](Json& r) { r["shard"]["scenes"][1]["detectors"].erase(0); },
                {"scene \"two\"", "detectors"}),
        changed("NumberOfShards", [](Json& r) { r["shard"]["of"] = 3; }, {"shard.of is 3"})),
    test_name);

INSTANTIATE_TEST_SUITE_P(
    NotAll, Refused,
    testing::Values(
        BadShards{"Missing", {}, {}, {"DIR/1/results.json"}, {"shard 2/2 is missing"}},
        BadShards{"FirstMissing", {}, {}, {"DIR/2/results.json"}, {"shard 1/2 is missing"}},
        BadShards{"Doubled",
                  {},
                  {},
                  {"DIR/2/results.json", "DIR/1/results.json", "DIR/2/results.json"},
                  {"DIR/2/results.json and DIR/2/results.json are both shard 2/2"}},
        changed("NoShard", [](Json& r) { r.erase("shard"); }, {"is no shard of a run"}),
        changed("BeyondTheLast", [](Json& r) { r["shard"]["index"] = 3; }, {"shard 3/2"}),
        changed("LacksAScene", [](Json& r) { r["scenes"] = Json::array(); }, {"scene \"two\""}),
        changed("LacksADetector", [](Json& r) { r["runs"].erase(1); },
                {"detector \"ffd-grid\" on scene \"two\""}),
        changed("RunTwice", [](Json& r) { r["runs"].push_back(r["runs"][0]); }, {"does not hold"})),
    test_name);

INSTANTIATE_TEST_SUITE_P(
    Damaged, Refused,
    testing::Values(
        spoilt("Recording", [](const fs::path& d) { cut(d / "recordings" / "two.ccr"); },
               {"DIR/2/recordings/two.ccr: is damaged", "shard 2/2"}),
        spoilt("Contacts", [](const fs::path& d) { append_to(d / "contacts" / "two.json"); },
               {"DIR/2/contacts/two.json: is damaged"}),
        spoilt("Case", [](const fs::path& d) { append_to(d / "cases" / "0001.json"); },
               {"DIR/2/cases/0001.json: is damaged"}),
        spoilt("NoRecording", [](const fs::path& d) { fs::remove(d / "recordings" / "two.ccr"); },
               {"DIR/2/recordings/two.ccr: is missing"}),
        spoilt("NoCase", [](const fs::path& d) { fs::remove(d / "cases" / "0001.json"); },
               {"DIR/2/cases/0001.json: is missing"}),
        spoilt("ResultsCutShort", [](const fs::path& d) { cut(d / "results.json"); },
               {"DIR/2/results.json: not JSON at byte"}),
        spoilt("NoResults", [](const fs::path& d) { fs::remove(d / "results.json"); },
               {"DIR/2/results.json"}),
        changed("FieldMissing", [](Json& r) { r["shard"].erase("files"); }, {"files"}),
        changed("FieldOfAnotherKind", [](Json& r) { r["shard"]["of"] = "two"; }, {"of"}),
        changed("CaseElsewhere",
                [](Json& r) { r["disagreements"][0]["case"] = "cases/../../1/results.json"; },
                {"no name of a case file"}),
        changed("RecordingElsewhere",
                [](Json& r) { r["runs"][0]["recording"] = "../1/recordings/one.ccr"; },
                {"no name of a recording"})),
    test_name);

TEST(Merge, DoesNotWriteOverAShard) {
  const test::Scratch scratch;
  for (const char* part : {"1", "2"})
    fs::copy(good_shards().folder() / part, scratch.folder() / part, fs::copy_options::recursive);
  test::expect_refused(
      {"", {"merge", "DIR/1/results.json", "DIR/2/results.json", "--out", "DIR/1"}, {"shard 1/2"}},
      scratch);
}

}  // namespace
}  // namespace contactcheck::cli
