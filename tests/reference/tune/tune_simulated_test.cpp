// contactcheck tune of simulated scenes, as it is run.
#include <map>

#include "reference/text/shell_word.h"
#include "tests/reference/tune/falling_scene.h"
#include "tests/reference/tune/tune_program.h"

namespace contactcheck::tune {
namespace {

using Json = nlohmann::ordered_json;
using test::contactcheck_program;
using test::Outcome;
using ::testing::HasSubstr;

class TuneSimulated : public test::TuneProgram {
 protected:
  TuneSimulated() : TuneProgram("falling.json", test::falling_scene()) {}
};

TEST_F(TuneSimulated, SimulatesTheSceneAndHoldsOutEveryOtherFrame) {
  const Outcome tuned = tune({"--detector", "ffd-aabb+tri:cell=1", "--question", "triangles"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  EXPECT_EQ(result()["frames"], 6);
  EXPECT_EQ(result()["held_out_frames"], 6);
  EXPECT_FALSE(result().contains("deformers")) << "the deformer is the scene's, and costs nothing";
  EXPECT_THAT(tuned.out,
              HasSubstr("contactcheck run " + text::in_shell(scene_) + " --detector ffd-aabb+tri"));
  ASSERT_EQ(tune({"--detector", "ffd-aabb+tri:cell=1", "--frames", "4"}).exit_code, 0);
  EXPECT_EQ(result()["frames"], 4);
}

TEST_F(TuneSimulated, TriesEveryDeformerAndCountsWhatItsStepCosts) {
  const Outcome tuned =
      tune({"--deformer", "all", "--detector", "ffd-aabb+tri:bounds=safe,precision=double",
            "--exhaustive", "--question", "triangles"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  const Json json = result();
  std::map<std::string, double> step;
  for (const Json& deformer : json["deformers"])
    step[deformer["deformer"].get<std::string>()] = deformer["step_ms"].get<double>();
  ASSERT_EQ(step.size(), 3u);
  ASSERT_EQ(json["measured"].size(), 9u) << "3 hash cells, 3 deformers";
  for (const Json& m : json["measured"]) {
    const std::string deformer = m["deformer"];
    EXPECT_EQ(m["step_ms"], step.at(deformer));
    EXPECT_GT(m["cost_ms"], step.at(deformer));
    EXPECT_LE(m["cost_ms_low"], m["cost_ms"]);
    EXPECT_EQ(m["missed"], 0);
    if (deformer == "mass-spring") {
      EXPECT_EQ(m["deviation_max"], 0.0);
    } else {
      EXPECT_GT(m["deviation_max"], 0.0);
    }
  }
  EXPECT_THAT(tuned.out, HasSubstr("of it deforming"));
  EXPECT_THAT(tuned.out, HasSubstr("deforming, ms a step: mass-spring "));
  EXPECT_THAT(page(), HasSubstr("Deforming, ms a step: mass-spring "));
}

TEST_F(TuneSimulated, NamesASceneThatRunsWithTheChosenDeformer) {
  ASSERT_EQ(tune({"--deformer", "shape-matching", "--detector", "ffd-aabb+tri:bounds=safe,cell=1",
                  "--exhaustive"})
                .exit_code,
            0);
  const Json json = result();
  const std::string file = json["deformers"][1]["scene"];
  const Outcome run =
      contactcheck_program({"run", file, "--detector", "ffd-aabb+tri", "--no-timing", "--quiet",
                            "--out", (scratch_.folder() / "run").string()});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  // What is chosen is named by its own file, and the scene's own by the word that was given.
  const bool own = json["chosen"]["deformer"] == "mass-spring";
  EXPECT_EQ(json["chosen"]["scene"], own ? scene_ : file);
}

TEST_F(TuneSimulated, LimitsHowFarADeformerMayDeviate) {
  const Outcome tuned = tune({"--deformer", "all", "--detector", "ffd-aabb+tri:bounds=safe,cell=1",
                              "--max-deviation", "0", "--exhaustive"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  EXPECT_EQ(result()["chosen"]["deformer"], "mass-spring");
}

TEST_F(TuneSimulated, SaysWhichDeformerCouldNotBeSimulated) {
  // Every step is stable for shape matching; 10,000 substeps are too few for finite elements as
  // stiff.
  std::string stiff = test::falling_scene(
      R"({"model": "shape-matching", "mass": 5, "relaxation_time": 2e-6, "region": 1})");
  scratch_.write("falling.json", stiff);
  const Outcome tuned = tune({"--deformer", "finite-elements", "--detector",
                              "ffd-aabb+tri:bounds=safe,cell=1,precision=double", "--exhaustive"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  EXPECT_THAT(tuned.out, HasSubstr("Not tried: finite-elements: "));
  EXPECT_THAT(tuned.out, HasSubstr("too stiff"));
  EXPECT_EQ(result()["measured"].size(), 1u);
  EXPECT_THAT(result()["deformers"][1]["failure"].get<std::string>(), HasSubstr("too stiff"));
}

}  // namespace
}  // namespace contactcheck::tune
