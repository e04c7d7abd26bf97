// The file that contactcheck tune writes of its choice, as contactcheck run takes it.
#include "reference/text/shell_word.h"
#include "reference/tune/chosen_file.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/reference/tune/falling_scene.h"
#include "tests/reference/tune/tune_program.h"
#include "tests/support/mesh_text.h"
#include "tests/support/shapes.h"

namespace contactcheck::tune {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using test::contactcheck_program;
using test::names_in;
using test::Outcome;
using ::testing::HasSubstr;

const std::string kDetector = "ffd-aabb+tri:bounds=safe,cell=2";  // whose precision is to be chosen

/// Where the program is started.
class WorkingDirectory {
 public:
  explicit WorkingDirectory(const fs::path& folder) { fs::current_path(folder); }
  ~WorkingDirectory() { fs::current_path(before_); }

 private:
  const fs::path before_ = fs::current_path();
};

std::string with_box_of_file(std::string scene) {
  const std::string box = R"({"shape": "box", "divisions": 2})";
  for (std::size_t at; (at = scene.find(box)) != std::string::npos;)
    scene.replace(at, box.size(), R"({"file": "../meshes/box.obj"})");
  return scene;
}

class TuneChosen : public test::TuneProgram {
 protected:
  TuneChosen() : TuneProgram("tiny.json", test::tiny_scene("tiny", "9")) {}

  fs::path chosen() const { return fs::path(out_) / "chosen.json"; }
  Json suite() const { return Json::parse(test::text_of(chosen())); }

  /// The one row of a run.
  Json row_of(std::vector<std::string> words) const {
    const fs::path out = scratch_.folder() / "run";
    words.insert(words.begin(), "run");
    words.insert(words.end(), {"--no-timing", "--quiet", "--out", out.string()});
    const Outcome run = contactcheck_program(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    if (run.exit_code != 0) return {};
    const Json runs = Json::parse(test::text_of(out / "results.json")).at("runs");
    EXPECT_EQ(runs.size(), 1u);
    return runs.at(0);
  }

  /// Running the file and running the words of tune.json are one thing.
  void expect_that_run_takes(const std::string& file) const {
    const Json told = result().at("chosen");
    const Json row = row_of({file});
    const Json wanted = row_of({told.at("scene"), "--detector", told.at("detector")});
    ASSERT_TRUE(row.is_object() && wanted.is_object());
    EXPECT_EQ(row.at("status"), "ok");
    for (const char* key : {"scene", "detector", "options", "contact_hash"})
      EXPECT_EQ(row.at(key), wanted.at(key)) << key;
    EXPECT_EQ(row.at("detector"), told.at("detector"));
  }
};

TEST_F(TuneChosen, IsAFileThatRunTakesAsItStands) {
  const Outcome tuned = tune({"--detector", kDetector});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  EXPECT_EQ(result()["chosen"]["file"], "chosen.json");
  expect_that_run_takes(chosen().string());
  EXPECT_THAT(suite()["detectors"][0].get<std::string>(), HasSubstr("cell=2"));
  const std::string command = "  contactcheck run " + chosen().string() + "\n";
  EXPECT_THAT(tuned.out, HasSubstr(command));
  EXPECT_THAT(page(), HasSubstr(command));
  EXPECT_EQ(names_in(out_), (std::set<std::string>{"chosen.json", "tune.json", "tune.md"}))
      << "and no empty folder";
}

TEST_F(TuneChosen, NamesASceneThatComesAlongByItsId) {
  scene_ = "nested";
  ASSERT_EQ(tune({"--detector", kDetector, "--frames", "4"}).exit_code, 0);
  EXPECT_EQ(suite()["scenes"], Json::array({"nested"}));
  const Json row = row_of({chosen().string(), "--frames", "2"});
  EXPECT_EQ(row.at("scene"), "nested");
  EXPECT_EQ(row.at("detector"), result()["chosen"]["detector"]);
}

TEST_F(TuneChosen, FindsItsSceneFromAnyWorkingDirectoryAndWhenBothMove) {
  scratch_.write("project/meshes/box.obj",
                 test::obj_text(test::box_mesh({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 2)));
  scratch_.write("project/scenes/tiny.json", with_box_of_file(test::tiny_scene("tiny", "9")));
  const fs::path project = scratch_.folder() / "project";
  {
    const WorkingDirectory here(project);
    scene_ = "scenes/tiny.json";
    out_ = "out";
    const Outcome tuned = tune({"--detector", kDetector});
    ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
    EXPECT_EQ(suite()["scenes"][0]["file"], "../scenes/tiny.json");
    EXPECT_THAT(tuned.out, HasSubstr("  contactcheck run out/chosen.json\n"));
    expect_that_run_takes("out/chosen.json");
  }
  const WorkingDirectory elsewhere("/");
  EXPECT_EQ(row_of({(project / "out/chosen.json").string()}).at("scene"), "tiny");
  const fs::path moved = scratch_.folder() / "moved";
  fs::rename(project, moved);
  EXPECT_EQ(row_of({(moved / "out/chosen.json").string()}).at("scene"), "tiny");
}

TEST_F(TuneChosen, FindsItsSceneThroughALinkToTheFolder) {
  scratch_.write("far/away/readme", "");
  scratch_.write("project/meshes/box.obj",
                 test::obj_text(test::box_mesh({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 2)));
  scene_ =
      scratch_.write("project/scenes/tiny.json", with_box_of_file(test::tiny_scene("tiny", "9")));
  out_ = (scratch_.folder() / "project" / "out").string();
  fs::create_directory_symlink(scratch_.folder() / "far" / "away", out_);
  ASSERT_EQ(tune({"--detector", kDetector}).exit_code, 0);
  expect_that_run_takes(chosen().string());
  expect_that_run_takes((scratch_.folder() / "far" / "away" / "chosen.json").string());
}

TEST_F(TuneChosen, NamesTheSceneInLatticesOfItsOwn) {
  std::string fine = test::tiny_scene("tiny", "5");  // some 1,000 cells a body against 27
  for (std::size_t at; (at = fine.find("[3, 3, 3]")) != std::string::npos;)
    fine.replace(at, 9, "[14, 14, 14]");
  scratch_.write("tiny.json", fine);
  const Outcome tuned = tune({"--detector", kDetector + ",precision=double", "--lattice", "0.01",
                              "--exhaustive", "--max-missed", "1000"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  EXPECT_EQ(suite()["scenes"][0]["file"], "tune/scenes/tiny-lattice-1.json");
  EXPECT_THAT(tuned.out, HasSubstr("Within one lattice these ratios are compared"));
  expect_that_run_takes(chosen().string());
  const fs::path moved = scratch_.folder() / "moved";
  fs::rename(out_, moved);
  EXPECT_EQ(row_of({(moved / "chosen.json").string()}).at("scene"), "tiny-lattice-1");
}

TEST_F(TuneChosen, NamesTheSceneWithTheChosenDeformer) {
  scene_ = scratch_.write("falling.json", test::falling_scene()).string();
  const Outcome tuned = tune({"--deformer", "shape-matching", "--detector",
                              kDetector + ",precision=double", "--exhaustive"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  const bool own = result()["chosen"]["deformer"] == "mass-spring";
  EXPECT_EQ(suite()["scenes"][0]["file"],
            own ? "../falling.json" : "tune/scenes/falling-shape-matching.json");
  expect_that_run_takes(chosen().string());
}

TEST_F(TuneChosen, NamesARecording) {
  ASSERT_EQ(row_of({scene_, "--detector", "ffd-lazy"}).at("status"), "ok");
  fs::create_directory(out_);
  fs::copy_file(scratch_.folder() / "run/recordings/tiny.ccr", fs::path(out_) / "tiny.ccr");
  scene_ = out_ + "/tiny.ccr";
  ASSERT_EQ(tune({"--detector", kDetector}).exit_code, 0);
  EXPECT_EQ(suite()["scenes"][0]["file"], "tiny.ccr");
  expect_that_run_takes(chosen().string());
}

TEST_F(TuneChosen, SaysThatADetectorFromOutsideMustBeBroughtAlong) {
  const std::string own = "python3 -B " + text::in_shell(CONTACTCHECK_PIPE_EXAMPLE);
  const Outcome tuned = tune({"--detector-cmd", own, "--question", "triangles", "--frames", "4"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  EXPECT_THAT(tuned.out, HasSubstr("a file cannot bring in a detector from outside"));
  const std::string detector = result()["chosen"]["detector"];
  EXPECT_THAT(tuned.out, HasSubstr("contactcheck run " + text::in_shell(chosen().string()) +
                                   " --detector-cmd " + text::in_shell(own) + " --detector " +
                                   detector + "\n"));
  const Json row = row_of({chosen().string(), "--detector-cmd", own, "--detector", detector});
  EXPECT_EQ(row.at("scene"), "tiny");
  EXPECT_EQ(row.at("detector"), detector);
  const Outcome alone = contactcheck_program({"run", chosen().string(), "--out", out_});
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_THAT(alone.err, HasSubstr("unknown detector \"python-sweep\""));
}

TEST_F(TuneChosen, DoesNotStayFromAnEarlierRun) {
  ASSERT_EQ(tune({"--detector", kDetector}).exit_code, 0);
  ASSERT_TRUE(fs::exists(chosen()));
  // Boxes round the pieces of spheres touch before the spheres do: bodies hover.
  std::string spheres = test::tiny_scene("tiny", "9");
  for (std::size_t at; (at = spheres.find("\"box\", \"divisions\"")) != std::string::npos;)
    spheres.replace(at, 5, "\"sphere\"");
  scratch_.write("tiny.json", spheres);
  const Outcome tuned = tune({"--detector", "ffd-aabb:precision=double", "--max-hover", "0"});
  EXPECT_EQ(tuned.exit_code, 1) << tuned.out;
  EXPECT_EQ(names_in(out_), (std::set<std::string>{"tune.json", "tune.md"}));
  EXPECT_THAT(tuned.out, ::testing::Not(HasSubstr("chosen.json")));
}

TEST_F(TuneChosen, LeavesNothingBehindForASceneThatCannotBeTuned) {
  scene_ = "hard-vertex-face";
  EXPECT_EQ(tune({}).exit_code, 2);
  EXPECT_EQ(names_in(out_), std::set<std::string>{});
}

TEST_F(TuneChosen, IsNotWrittenOverTheSceneItself) {
  const std::string text = test::tiny_scene("chosen", "9");
  scene_ = scratch_.write("out/chosen.json", text).string();
  const Outcome refused = tune({"--detector", kDetector});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("lies where the choice is to be written"));
  EXPECT_EQ(test::text_of(scene_), text);
}

TEST_F(TuneChosen, TablesMarkTheAnchorThatCostsAreRatiosTo) {
  const Outcome tuned = tune({"--detector", kDetector + ",precision=double"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  ASSERT_EQ(result()["measured"].size(), 1u) << "which is then the anchor";
  EXPECT_EQ(result()["anchor"], result()["measured"][0]["detector"]);
  const std::string words = "the anchor: " + result()["anchor"].get<std::string>() + ".\n";
  EXPECT_THAT(tuned.out, HasSubstr(words));
  EXPECT_THAT(page(), HasSubstr(words));
  EXPECT_THAT(tuned.out, HasSubstr("the anchor       0"));
  EXPECT_THAT(page(), HasSubstr("| the anchor | 0 |"));
}

}  // namespace
}  // namespace contactcheck::tune
