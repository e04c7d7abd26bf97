// Runs that are killed: what they leave as it was, and what `run --resume` takes over.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/reference/cli/program.h"
#include "tests/reference/cli/run_files.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/reference/scene/scratch.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
// Ordered: what is kept is compared with its order.
using Json = nlohmann::ordered_json;
using test::contactcheck_program;
using test::names_in;
using test::Outcome;
using test::RunningProgram;
using test::text_of;
using test::tiny_scene;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

// Long enough that a run is still in it when the test has seen the first scene finished.
constexpr const char* kManyFrames = "3000";

std::map<std::string, std::string> texts_in(const fs::path& folder) {
  std::map<std::string, std::string> out;
  for (const std::string& name : names_in(folder)) out[name] = text_of(folder / name);
  return out;
}

// By scene and detector.
std::map<std::string, std::string> hashes_of(const Json& results) {
  std::map<std::string, std::string> out;
  for (const Json& run : results.at("runs"))
    out[run.at("scene").get<std::string>() + " " + run.at("detector").get<std::string>()] =
        run.at("contact_hash");
  return out;
}

class Resume : public testing::Test {
 protected:
  Resume() {
    scratch_.write("first.json", first());
    scratch_.write("second.json", tiny_scene("second", kManyFrames));
    scratch_.write("corner.obj", "v 0.4 0 0\nv 1.4 0 0\nv 0.4 1 0\nf 1 2 3\n");
  }

  // With a mesh out of a file, which may change under a scene that does not.
  static std::string first(const std::string& frames = "5") {
    return R"({"id": "first", "title": "A box and a triangle", "duration": 1, "frames": )" +
           frames + R"(, "levels": ["body", "cell", "triangle"], "bodies": [
      {"name": "box", "mesh": {"shape": "box"}, "lattice": {"cells": [3, 3, 3]},
       "motion": {"position": [[0, [-0.6, 0.1, 0.2]], [1, [0.2, 0.1, 0.2]]]}},
      {"name": "corner", "mesh": {"file": "corner.obj"}, "lattice": {"cells": [2, 2, 2]}}]})";
  }

  fs::path out() const { return scratch_.folder() / "out"; }
  fs::path kept() const { return out() / "partial" / "first.partial.json"; }
  std::string scene(const std::string& id) const {
    return (scratch_.folder() / (id + ".json")).string();
  }
  Words command(Words scenes, const std::string& folder = "out", const Words& more = {}) const {
    Words words = {
        "run",        "--no-timing",  "--detector", "ffd-grid",
        "--detector", "ffd-aabb+tri", "--out",      (scratch_.folder() / folder).string()};
    for (const std::string& id : scenes) words.push_back(scene(id));
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  Words both(const Words& more = {}) const { return command({"first", "second"}, "out", more); }

  Json run(const Words& arguments, const std::string& folder = "out") {
    last_ = contactcheck_program(arguments);
    EXPECT_EQ(last_.exit_code, 0) << last_.err;
    const fs::path file = scratch_.folder() / folder / "results.json";
    const Outcome valid =
        test::run_program(CONTACTCHECK_PYTHON3, {"-B", CONTACTCHECK_VALIDATOR, file.string()});
    EXPECT_EQ(valid.exit_code, 0) << valid.out << valid.err;
    return Json::parse(text_of(file));
  }

  // Ends a run by `signal` when its first scene is finished and the worker of its second is at
  // work.
  void interrupt(const Words& arguments, int signal = SIGKILL) {
    RunningProgram program(CONTACTCHECK_PROGRAM, arguments);
    const fs::path second = out() / "recordings" / "second.ccr";
    for (int i = 0; i < 12'000 && !program.has_ended(); ++i) {
      if (fs::exists(kept()) && fs::exists(second)) break;
      usleep(5'000);
    }
    ASSERT_TRUE(fs::exists(kept())) << "the first scene was never finished";
    program.send(signal);
    last_ = program.outcome();
    EXPECT_EQ(last_.exit_code, 128 + signal) << "it was not in its second scene";
  }

  Json resumed() { return run(both({"--resume"})); }

  // After an interruption, whatever was kept of the first scene. (The second would only take time.)
  Json first_resumed(Words more = {}) {
    more.push_back("--resume");
    return run(command({"first"}, "out", more));
  }
  void expect_run_again(const Words& more = {}) {
    EXPECT_EQ(first_resumed(more).at("resumed"), Json::array());
    EXPECT_EQ(last_.err, "scene 1 of 1: first\n");
    EXPECT_FALSE(fs::exists(out() / "partial"));
  }

  test::Scratch scratch_;
  Outcome last_;
};

TEST_F(Resume, KilledRunsLeaveEarlierResultsAsTheyWere) {
  run({"run", scene("first"), "--no-timing", "--detector", "ffd-grid", "--out", out().string()});
  const std::string results = text_of(out() / "results.json"),
                    report = text_of(out() / "report.md");
  const auto cases = texts_in(out() / "cases"), contacts = texts_in(out() / "contacts");
  ASSERT_NE(results, "");
  ASSERT_FALSE(cases.empty());
  for (const int signal : {SIGKILL, SIGINT, SIGTERM}) {
    interrupt(both(), signal);
    EXPECT_EQ(text_of(out() / "results.json"), results) << "signal " << signal;
    EXPECT_EQ(text_of(out() / "report.md"), report) << "signal " << signal;
    EXPECT_EQ(texts_in(out() / "cases"), cases) << "signal " << signal;
    EXPECT_EQ(texts_in(out() / "contacts"), contacts) << "signal " << signal;
    fs::remove(kept());
  }
}

TEST_F(Resume, InterruptedRunTakesItsScratchFolderAway) {
  interrupt(both(), SIGINT);
  EXPECT_THAT(names_in(out()), ElementsAre("cases", "contacts", "partial", "recordings"));
  EXPECT_THAT(names_in(out() / "partial"), ElementsAre("first.partial.json"));
}

TEST_F(Resume, InterruptedRunSaysHowItGoesOn) {
  const std::string sentence =
      "contactcheck: interrupted; finished scenes are kept: repeat the command with --resume to "
      "continue\n";
  for (const int signal : {SIGINT, SIGTERM}) {
    interrupt(both(), signal);
    EXPECT_EQ(last_.err, "scene 1 of 2: first\nscene 2 of 2: second\n" + sentence);
    fs::remove_all(out());
  }
  interrupt(both({"--quiet", "--json-lines"}), SIGINT);
  EXPECT_EQ(last_.err, sentence);
}

// Their results would be those of one and their recordings those of the other.
TEST_F(Resume, SecondRunIntoAFolderIsRefusedUntilTheFirstHasEnded) {
  RunningProgram holder(CONTACTCHECK_PROGRAM, command({"second"}));
  const fs::path recording = out() / "recordings" / "second.ccr";
  for (int i = 0; i < 12'000 && !holder.has_ended() && !fs::exists(recording); ++i) usleep(5'000);
  const Outcome refused = contactcheck_program(command({"first"}));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.err, "contactcheck: --out " + out().string() +
                             ": another run is writing there; wait for its end or name another "
                             "folder\n");
  ASSERT_FALSE(holder.has_ended()) << "it must hold its folder meanwhile";
  holder.send(SIGKILL);
  holder.outcome();
  EXPECT_EQ(first_resumed().at("runs").size(), 2u) << "at once";
}

TEST_F(Resume, GivesWhatAnUninterruptedRunGivesWithoutRunningTheFirstSceneAgain) {
  const Json whole = run(command({"first", "second"}, "whole"), "whole");
  interrupt(both());
  const Json results = resumed();
  EXPECT_EQ(results.at("resumed"), Json::array({"first"}));
  EXPECT_EQ(last_.err, "scene 2 of 2: second\n");
  EXPECT_EQ(hashes_of(results), hashes_of(whole));
  EXPECT_EQ(hashes_of(results).size(), 4u);
  EXPECT_EQ(results.at("scenes"), whole.at("scenes"));
  EXPECT_EQ(results.at("disagreements"), whole.at("disagreements"));
  EXPECT_EQ(results.at("disagreements").at(0).at("scene"), "first") << "there is a case to keep";
  EXPECT_EQ(texts_in(out() / "cases"), texts_in(scratch_.folder() / "whole" / "cases"));
  EXPECT_EQ(texts_in(out() / "contacts"), texts_in(scratch_.folder() / "whole" / "contacts"));
  EXPECT_THAT(names_in(out() / "contacts"), ElementsAre("first.json", "second.json"));
}

TEST_F(Resume, SaysWhatItTookOverAndLeavesNothingElse) {
  interrupt(both());
  resumed();
  EXPECT_THAT(last_.out, HasSubstr("resumed: first: finished by an earlier run\n"));
  EXPECT_THAT(last_.out, Not(HasSubstr("resumed: second")));
  EXPECT_THAT(text_of(out() / "report.md"), HasSubstr("interrupted (`--resume`)"));
  EXPECT_EQ(names_in(out()), test::run_files({"plots"}));
}

TEST_F(Resume, RowsAreThoseThatWereKept) {
  interrupt(both());
  Json file = Json::parse(text_of(kept()));
  file.at("results").at("runs").at(0).at("message") = "as it was kept";
  std::ofstream(kept()) << file.dump();
  EXPECT_EQ(first_resumed().at("runs").at(0).at("message"), "as it was kept");
  EXPECT_EQ(last_.err, "") << "no scene is run";
}

TEST_F(Resume, RunThatIsKilledAgainKeepsWhatItTookOver) {
  interrupt(both());
  const std::string bytes = text_of(kept());
  interrupt(both({"--resume"}), SIGINT);
  EXPECT_EQ(text_of(kept()), bytes);
  EXPECT_EQ(resumed().at("resumed"), Json::array({"first"}));
}

TEST_F(Resume, WithoutItEverySceneRunsAgain) {
  interrupt(both());
  EXPECT_FALSE(run(both()).contains("resumed"));
  EXPECT_THAT(last_.err, HasSubstr("scene 1 of 2: first\n"));
  EXPECT_THAT(text_of(out() / "report.md"), Not(HasSubstr("--resume")));
}

TEST_F(Resume, NothingToTakeOverIsNoError) { expect_run_again(); }

TEST_F(Resume, OtherFramesAreRunAgain) {
  interrupt(both());
  expect_run_again({"--frames", "4"});
}

TEST_F(Resume, OtherDetectorsAreRunAgain) {
  interrupt(both());
  expect_run_again({"--detector", "fcl-aabb"});
}

TEST_F(Resume, OtherLimitsAreRunAgain) {
  interrupt(both());
  expect_run_again({"--call-limit", "50"});
}

TEST_F(Resume, ChangedSceneIsRunAgain) {
  interrupt(both());
  scratch_.write("first.json", first("6"));
  expect_run_again();
}

TEST_F(Resume, ChangedMeshIsRunAgain) {
  interrupt(both());
  scratch_.write("corner.obj", "v 0.3 0 0\nv 1.4 0 0\nv 0.4 1 0\nf 1 2 3\n");
  expect_run_again();
}

TEST_F(Resume, SceneWithoutItsRecordingIsRunAgain) {
  interrupt(both());
  fs::remove(out() / "recordings" / "first.ccr");
  expect_run_again();
  EXPECT_TRUE(fs::exists(out() / "recordings" / "first.ccr"));
}

TEST_F(Resume, DamagedFilesAreRunAgain) {
  interrupt(both());
  const std::string bytes = text_of(kept());
  Json without_runs = Json::parse(bytes);
  without_runs.at("results").erase("runs");
  for (const std::string& damaged :
       {bytes.substr(0, bytes.size() / 2), std::string(), std::string("[]"), without_runs.dump(),
        std::string(100'000, '[')}) {
    scratch_.write("out/partial/first.partial.json", damaged);
    expect_run_again();
  }
}

TEST_F(Resume, FilesOfOthersStay) {
  interrupt(both());
  scratch_.write("out/partial/notes.txt", "mine");
  scratch_.write("out/partial/third.partial.json.77-0.tmp", "half");
  resumed();
  EXPECT_THAT(names_in(out() / "partial"), ElementsAre("notes.txt"));
}

}  // namespace
}  // namespace contactcheck::cli
