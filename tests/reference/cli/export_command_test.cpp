// contactcheck export: what it writes, what it replaces, and what it leaves behind when it cannot
// finish. That the certificates are right is tested in tests/reference/oracle.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "tests/reference/cli/program.h"
#include "tests/reference/cli/refusal.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/support/files.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::json;
using test::contactcheck_program;
using test::names_in;
using test::Outcome;
using test::text_of;
using test::tiny_scene;
using test::Words;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Export : public testing::Test {
 protected:
  Export() { scene_ = scratch_.write("tiny.json", tiny_scene()).string(); }

  Outcome exported(const Words& words) const {
    Words all = {"export"};
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.end(), {"--out", out_.string()});
    return contactcheck_program(all);
  }

  json index(const std::string& id = "tiny") const {
    return json::parse(text_of(out_ / id / "scene.json"));
  }

  // The checker that lies in the folder is content with it.
  void expect_proven(const std::string& id, const std::string& frames) const {
    const Outcome check =
        test::run_program(CONTACTCHECK_PYTHON3, {"-B", (out_ / id / "check.py").string()});
    EXPECT_EQ(check.exit_code, 0) << check.err;
    EXPECT_THAT(check.out, testing::StartsWith(id + ": " + frames + " frames proven: "));
  }

  test::Scratch scratch_;
  std::string scene_;
  const fs::path out_ = scratch_.folder() / "out";
};

TEST_F(Export, WritesAFolderThatProvesItself) {
  const Outcome outcome = exported({scene_});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr((out_ / "tiny").string() + ": 5 frames; "));
  EXPECT_THAT(outcome.out, HasSubstr(index().at("contact_hash").get<std::string>()));
  EXPECT_THAT(names_in(out_), ElementsAre("tiny"));
  EXPECT_THAT(names_in(out_ / "tiny"), ElementsAre("bodies", "check.py", "scene.json", "truth"));
  EXPECT_THAT(names_in(out_ / "tiny" / "bodies"), ElementsAre("0-left", "1-right"));
  EXPECT_THAT(names_in(out_ / "tiny" / "truth"),
              ElementsAre("frame_0000.json", "frame_0001.json", "frame_0002.json",
                          "frame_0003.json", "frame_0004.json"));
  expect_proven("tiny", "5");
}

TEST_F(Export, EveryTakesSomeOfTheFrames) {
  EXPECT_EQ(exported({scene_, "--frames", "10", "--every", "4"}).exit_code, 0);
  EXPECT_THAT(names_in(out_ / "tiny" / "truth"),
              ElementsAre("frame_0000.json", "frame_0004.json", "frame_0008.json"));
  EXPECT_EQ(index().at("scene_frames"), 10);
  expect_proven("tiny", "3");
}

TEST_F(Export, OfARecordingHasTheSameHash) {
  EXPECT_EQ(exported({scene_}).exit_code, 0);
  const json hash = index().at("contact_hash");
  EXPECT_EQ(contactcheck_program({"run", scene_, "--quiet", "--no-timing", "--detector", "fcl-aabb",
                                  "--out", (scratch_.folder() / "run").string()})
                .exit_code,
            0);
  const fs::path recording = scratch_.folder() / "run" / "recordings" / "tiny.ccr";
  EXPECT_EQ(exported({recording.string()}).exit_code, 0);
  EXPECT_EQ(index().at("contact_hash"), hash);
  expect_proven("tiny", "5");
}

TEST_F(Export, OfASuiteIsAFolderPerScene) {
  const fs::path fixtures = scratch_.folder() / "fixtures";
  scratch_.write("fixtures/scenes/one.json", tiny_scene("one", "3"));
  scratch_.write("fixtures/scenes/two.json", tiny_scene("two", "2"));
  scratch_.write("fixtures/suites/both.json",
                 R"({"id": "both", "scenes": ["one", "two"], "detectors": ["fcl-aabb"]})");
  const test::Environment environment("CONTACTCHECK_FIXTURES", fixtures.string());
  const Outcome outcome = exported({"both"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(names_in(out_), ElementsAre("one", "two"));
  expect_proven("one", "3");
  expect_proven("two", "2");
}

TEST_F(Export, ReplacesAnEarlierOneWhole) {
  EXPECT_EQ(exported({scene_}).exit_code, 0);
  EXPECT_EQ(exported({scene_, "--frames", "2"}).exit_code, 0);
  EXPECT_THAT(names_in(out_), ElementsAre("tiny"));
  EXPECT_THAT(names_in(out_ / "tiny" / "truth"), ElementsAre("frame_0000.json", "frame_0001.json"));
  expect_proven("tiny", "2");
}

TEST_F(Export, LeavesAloneWhatIsNoExport) {
  scratch_.write("out/tiny/scene.json", R"({"id": "tiny"})");
  test::expect_refused({"",
                        {"export", "DIR/tiny.json", "--out", "DIR/out"},
                        {"DIR/out/tiny", "is there already and is no export"}},
                       scratch_);
}

TEST_F(Export, InterruptedLeavesNothing) {
  const std::string file = scratch_.write("long.json", tiny_scene("long", "100000")).string();
  test::RunningProgram running(CONTACTCHECK_PROGRAM, {"export", file, "--out", out_.string()});
  const auto has_begun = [&] {
    if (!fs::exists(out_)) return false;
    for (const auto& entry :
         fs::recursive_directory_iterator(out_, fs::directory_options::skip_permission_denied))
      if (entry.path().filename() == "frame_0002.json") return true;
    return false;
  };
  while (!has_begun() && !running.has_ended()) usleep(10000);
  running.send(SIGINT);
  EXPECT_EQ(running.outcome().exit_code, 128 + SIGINT);
  EXPECT_THAT(names_in(out_), IsEmpty());
}

// Files may not grow beyond some size: whatever cannot be written, nothing passes for an export,
// and the earlier one stays as it was.
TEST_F(Export, FullDiskLeavesAllOrNothing) {
  EXPECT_EQ(exported({scene_, "--frames", "2"}).exit_code, 0);
  const std::string before = text_of(out_ / "tiny" / "scene.json");
  int refused = 0, whole = 0;
  for (int blocks = 1; blocks <= 256; blocks *= 2) {
    const Outcome outcome = test::run_program(
        "/bin/sh", {"-c", "ulimit -f " + std::to_string(blocks) + "; exec \"$0\" \"$@\"",
                    CONTACTCHECK_PROGRAM, "export", scene_, "--out", out_.string()});
    EXPECT_THAT(names_in(out_), ElementsAre("tiny"));
    if (outcome.exit_code == 0) {
      ++whole;
      expect_proven("tiny", "5");
      continue;
    }
    ++refused;
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("File too large"));
    EXPECT_EQ(text_of(out_ / "tiny" / "scene.json"), before);
  }
  EXPECT_GT(refused, 1);
  EXPECT_GT(whole, 0);
}

}  // namespace
}  // namespace contactcheck::cli
