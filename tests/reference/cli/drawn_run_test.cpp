// `run drawn`: whole runs of small drawn scenes, whole and in shards, and what is refused.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/reference/cli/program.h"
#include "tests/reference/cli/run_files.h"
#include "tests/reference/scene/scratch.h"
#include "tests/reference/scene/small_draw_rules.h"
#include "tests/support/files.h"
#include "tests/support/mesh_text.h"
#include "tests/support/sanitizers.h"
#include "tests/support/shapes.h"

namespace contactcheck::cli {
namespace {

using nlohmann::json;
using test::contactcheck_program;
using test::Outcome;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

class DrawnRun : public testing::Test {
 protected:
  DrawnRun() { rules_ = scratch_.write("rules.json", test::small_draw_rules()).string(); }

  std::string in(const std::string& name) const { return (scratch_.folder() / name).string(); }
  Outcome run(const std::string& out, Words more) const {
    Words words = {"run", rules_, "--no-timing", "--quiet", "--out", in(out)};
    words.insert(words.end(), more.begin(), more.end());
    return contactcheck_program(words);
  }
  json scenes(const std::string& out) const {
    return json::parse(test::text_of(in(out) + "/results.json")).at("scenes");
  }

  // The section of drawn scenes.
  std::string reported(const std::string& out) const {
    const std::string text = test::text_of(in(out) + "/report.md");
    const std::size_t begin = text.find("## Drawn scenes\n");
    if (begin == std::string::npos) return "";
    return text.substr(begin, text.find("\n## ", begin) - begin);
  }
  // Rules whose scenes have so many triangles, written into a file.
  std::string rules_of(const std::string& triangles) const {
    std::string text = test::small_draw_rules(R"("touch": 1)");
    const auto put = [&text](const std::string& key, const std::string& value) {
      const std::size_t begin = text.find("\"" + key + "\": ") + key.size() + 4;
      text.replace(begin, text.find(",\n", begin) - begin, value);
    };
    put("triangles", triangles);
    put("most_triangles", "400000");
    put("bodies", "[2, 2]");
    return scratch_.write("triangles.json", text).string();
  }

  test::Scratch scratch_;
  std::string rules_;
};

TEST_F(DrawnRun, InShardsIsTheWholeOne) {
  const Words three = {"--seed", "7", "--count", "3"};
  ASSERT_EQ(run("whole", three).exit_code, 0);
  for (const char* part : {"1", "2"}) {
    Words words = three;
    words.insert(words.end(), {"--shard", std::string(part) + "/2"});
    const Outcome outcome = run(part, words);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  const Outcome merged = contactcheck_program(
      {"merge", in("1/results.json"), in("2/results.json"), "--out", in("merged")});
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  const json whole = scenes("whole");
  EXPECT_EQ(scenes("merged"), whole);
  EXPECT_THAT(reported("whole"), HasSubstr("3 scenes drawn from seed 7"));
  EXPECT_EQ(reported("merged"), reported("whole"));
  ASSERT_EQ(whole.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(whole[i].at("id"), "drawn-7-" + std::to_string(i + 1));
    EXPECT_EQ(whole[i].at("drawn").at("seed"), 7);
    EXPECT_EQ(whole[i].at("drawn").at("number"), i + 1);
    EXPECT_EQ(whole[i].at("drawn").at("redrawn"), 0);
    EXPECT_FALSE(whole[i].contains("separation"));
  }
}

TEST_F(DrawnRun, ASavedSceneRunsAgainWithTheSameTruth) {
  ASSERT_EQ(run("drawn", {"--seed", "3", "--count", "2", "--save-scene", in("kept")}).exit_code, 0);
  const Outcome again =
      contactcheck_program({"run", in("kept/drawn-3-2.json"), "--no-timing", "--quiet",
                            "--detector", "full-refit", "--out", in("again")});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(scenes("again").at(0), scenes("drawn").at(1));
}

TEST_F(DrawnRun, ASavedSceneNamesItsMeshesFromItsOwnFolder) {
  scratch_.write("meshes/box.obj", test::obj_text(test::unit_box_mesh(3)));
  scratch_.write("meshes/ball.obj", test::obj_text(test::sphere_mesh(Vec3::Zero(), 2.0, 2)));
  const Words meshes = {"--mesh", in("meshes/box.obj"), "--mesh", in("meshes/ball.obj")};
  Words words = {"--seed", "3", "--count", "2", "--save-scene", in("first/kept")};
  words.insert(words.end(), meshes.begin(), meshes.end());
  const Outcome outcome = run("drawn", words);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(test::text_of(in("first/kept/drawn-3-1.json")), Not(HasSubstr(in(""))));
  // Moved together, they are found all the same.
  namespace fs = std::filesystem;
  fs::create_directory(in("moved"));
  fs::rename(in("first"), in("moved/first"));
  fs::rename(in("meshes"), in("moved/meshes"));
  const Outcome again =
      contactcheck_program({"run", in("moved/first/kept/drawn-3-1.json"), "--no-timing", "--quiet",
                            "--detector", "full-refit", "--out", in("again")});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(scenes("again").at(0).at("truth_hash"), scenes("drawn").at(0).at("truth_hash"));
}

// Of this seed the first scene has 135,784 triangles a body, far too many for the limit, and the
// one drawn in its place 137.
TEST_F(DrawnRun, ASceneThatPassesALimitIsDrawnAgainAndCounted) {
  if (test::kSanitizerAllocates) GTEST_SKIP() << "a sanitizer needs memory of its own";
  rules_ = rules_of("[100, 200000]");
  const Outcome outcome = run("limited", {"--seed", "1", "--count", "1", "--memory-limit", "64",
                                          "--save-scene", in("kept.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json scene = scenes("limited").at(0);
  EXPECT_GE(scene.at("drawn").at("redrawn"), 1);
  EXPECT_FALSE(scene.contains("unjudged"));
  EXPECT_THAT(reported("limited"), HasSubstr("1 of them was drawn again because a limit"));
  const Outcome again = contactcheck_program({"run", in("kept.json"), "--no-timing", "--quiet",
                                              "--detector", "full-refit", "--out", in("again")});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(scenes("again").at(0), scene);
}

TEST_F(DrawnRun, AScenePassingALimitEachTimeIsNotJudgedAndTheRunGoesOn) {
  if (test::kSanitizerAllocates) GTEST_SKIP() << "a sanitizer needs memory of its own";
  rules_ = rules_of("[199000, 200000]");
  const Outcome outcome = run("limited", {"contact", "--detector", "full-refit", "--seed", "1",
                                          "--count", "1", "--memory-limit", "64"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  const json all = scenes("limited");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].at("drawn").at("redrawn"), 5);
  EXPECT_THAT(all[0].at("unjudged").get<std::string>(),
              HasSubstr("phase scene: more than 64 MiB resident (memory limit), before any "
                        "detector: this scene cannot be made, like the 5 drawn in its place"));
  EXPECT_GT(all[1].at("truth").at("body"), 0);
  EXPECT_THAT(reported("limited"), HasSubstr("1 could not be judged within the limits"));
}

TEST_F(DrawnRun, RefusesWhatItCannotDrawAndWritesNothing) {
  const std::string reversed = scratch_
                                   .write("reversed.json",
                                          [] {
                                            std::string text = test::small_draw_rules();
                                            return text.replace(text.find("[2, 4]"), 6, "[4, 2]");
                                          }())
                                   .string();
  const std::string point =
      scratch_.write("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n").string();
  const std::vector<std::pair<Words, std::string>> all = {
      {{"run", "drawn", "--count", "0"}, "--count"},
      {{"run", "drawn", "--count", "1000000000"}, "--count"},
      {{"run", "drawn", "--seed", "seven"}, "--seed"},
      {{"run", "contact", "--count", "3"}, "--count: no target of this run is the suite drawn"},
      {{"run", "drawn", "--frames", "3"}, "--frames: the scenes of \"drawn\" are drawn"},
      {{"run", "drawn", "--mesh", point}, "is a point and can meet nothing"},
      {{"run", "drawn", "--mesh", in("none.obj")}, "none.obj\" does not exist"},
      {{"run", "drawn-7"}, "\"drawn-7\" is no drawn scene"},
      {{"run", "drawn-7-0"}, "\"drawn-7-0\" is no drawn scene"},
      {{"run", "drawn-x-1"}, "\"drawn-x-1\" is no drawn scene"},
      {{"run", reversed}, "bodies is reversed"},
  };
  for (const auto& [words, sentence] : all) {
    Words with_out = words;
    with_out.insert(with_out.end(), {"--out", in("refused")});
    const Outcome outcome = contactcheck_program(with_out);
    EXPECT_EQ(outcome.exit_code, 2) << sentence;
    EXPECT_THAT(outcome.err, HasSubstr(sentence));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(in("refused"))) << sentence;
  }
}

}  // namespace
}  // namespace contactcheck::cli
