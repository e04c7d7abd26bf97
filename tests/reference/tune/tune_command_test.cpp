// contactcheck tune, as it is run.
#include <sstream>

#include "reference/text/shell_word.h"
#include "tests/reference/cli/tiny_scene.h"
#include "tests/reference/tune/tune_program.h"

namespace contactcheck::tune {
namespace {

using Json = nlohmann::ordered_json;
using test::contactcheck_program;
using test::Outcome;
using ::testing::HasSubstr;

class TuneCommand : public test::TuneProgram {
 protected:
  TuneCommand() : TuneProgram("tiny.json", test::tiny_scene("tiny", "9")) {}
};

TEST_F(TuneCommand, ChoosesAConfigurationThatRunConfirms) {
  const Outcome tuned = tune(
      {"--detector", "ffd-aabb+tri:precision=double", "--detector", "ffd-aabb:precision=double"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  const Json json = result();
  EXPECT_EQ(json["schema"], "contactcheck-tune/1");
  EXPECT_EQ(json["candidates"], 12);
  EXPECT_EQ(json["frames"], 9);
  EXPECT_EQ(json["held_out_frames"], 8);
  const std::string chosen = json["chosen"]["detector"];
  EXPECT_EQ(json["chosen"]["missed"], 0);
  const std::string command =
      "contactcheck run " + text::in_shell(scene_) + " --detector " + chosen;
  EXPECT_THAT(tuned.out, HasSubstr(command));
  EXPECT_THAT(page(), HasSubstr(command));
  const Outcome run = contactcheck_program(
      {"run", scene_, "--detector", chosen, "--no-timing", "--quiet", "--out", out_});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json row =
      Json::parse(test::text_of(std::filesystem::path(out_) / "results.json"))["runs"][0];
  EXPECT_EQ(row["levels"]["body"]["missed"], 0);
}

TEST_F(TuneCommand, SaysHowSureACostIsAndWhatIsAsCheap) {
  const Outcome tuned = tune({"--detector", "ffd-aabb:precision=double"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  const Json json = result();
  std::size_t times = 0;
  for (const Json& m : json["measured"]) {
    EXPECT_LE(m["cost_ms_low"], m["cost_ms"]);
    EXPECT_LE(m["cost_ms"], m["cost_ms_high"]);
    times += m["times"].get<std::size_t>();
  }
  EXPECT_EQ(json["measurements"], times);
  EXPECT_THAT(tuned.out, HasSubstr("  interval  "));
  EXPECT_THAT(tuned.out, ::testing::Not(HasSubstr("95 %"))) << "of few passes";
  const std::string words =
      json["as_cheap"].empty()
          ? "Nothing else that was measured and meets the limits is as cheap within noise."
          : "As cheap within noise: " + json["as_cheap"][0]["detector"].get<std::string>();
  EXPECT_THAT(tuned.out, HasSubstr(words));
  EXPECT_THAT(page(), HasSubstr(words));
}

// What is measured again is not another configuration.
TEST_F(TuneCommand, TellsOnTheWayHowManyConfigurationsWereMeasured) {
  const Outcome tuned = tune({"--detector", "ffd-aabb:precision=double"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  std::istringstream lines(tuned.err);
  std::size_t last = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.find("configurations measured") != std::string::npos) last = std::stoul(line);
  EXPECT_EQ(last, result()["measured"].size());
}

TEST_F(TuneCommand, MeasuresEveryConfigurationWhenTold) {
  ASSERT_EQ(tune({"--detector", "ffd-aabb:precision=double", "--exhaustive"}).exit_code, 0);
  EXPECT_EQ(result()["measured"].size(), 6u);
}

TEST_F(TuneCommand, SaysThatNothingMeetsTheLimits) {
  // Boxes round the pieces of spheres touch before the spheres do: bodies hover.
  std::string spheres = test::tiny_scene("tiny", "9");
  for (std::size_t at; (at = spheres.find("\"box\", \"divisions\"")) != std::string::npos;)
    spheres.replace(at, 5, "\"sphere\"");
  scratch_.write("tiny.json", spheres);
  const Outcome tuned = tune({"--detector", "ffd-aabb", "--max-hover", "0"});
  EXPECT_EQ(tuned.exit_code, 1) << tuned.out;
  EXPECT_THAT(tuned.out, HasSubstr("No configuration meets the limits."));
  EXPECT_TRUE(result()["chosen"].is_null());
}

TEST_F(TuneCommand, SaysThatTheChosenOneIsBeyondTheBudget) {
  const Outcome tuned = tune({"--detector", "ffd-aabb+tri:cell=3", "--budget-ms", "0.000001"});
  EXPECT_EQ(tuned.exit_code, 1);
  EXPECT_THAT(tuned.out, HasSubstr("more than the 1e-06 ms that are allowed"));
  EXPECT_FALSE(result()["within_budget"]);
}

TEST_F(TuneCommand, TriesOtherLattices) {
  const Outcome tuned = tune({"--detector", "ffd-aabb+tri:cell=3,bounds=paper,precision=double",
                              "--lattice", "0.04", "--exhaustive", "--max-missed", "1000"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  const Json json = result();
  ASSERT_EQ(json["measured"].size(), 2u);
  EXPECT_EQ(json["measured"][0]["deviation_max"], 0.0);
  EXPECT_GT(json["measured"][1]["deviation_max"], 1e-4);
}

TEST_F(TuneCommand, KeepsLatticesApartThatDifferByLessThanAPercent) {
  const Outcome tuned =
      tune({"--detector", "ffd-aabb+tri:cell=3,bounds=paper,precision=double", "--lattice", "0.041",
            "--lattice", "0.044", "--lattice", "0.044", "--exhaustive", "--max-missed", "1000"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  ASSERT_EQ(result()["measured"].size(), 3u);
}

TEST_F(TuneCommand, NamesACommandThatRunsADetectorFromOutside) {
  const std::string own = "python3 -B " + text::in_shell(CONTACTCHECK_PIPE_EXAMPLE);
  const Outcome tuned = tune({"--detector-cmd", own, "--question", "triangles", "--frames", "4"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  EXPECT_THAT(tuned.out,
              HasSubstr("--detector-cmd " + text::in_shell(own) + " --detector python-sweep"));
}

TEST_F(TuneCommand, TakesARecordingEveryOtherFrameOfWhichIsHeldOut) {
  ASSERT_EQ(contactcheck_program(
                {"run", scene_, "--detector", "ffd-lazy", "--no-timing", "--quiet", "--out", out_})
                .exit_code,
            0);
  scene_ = out_ + "/recordings/tiny.ccr";
  const Outcome tuned = tune({"--detector", "ffd-lazy", "--question", "triangles"});
  ASSERT_EQ(tuned.exit_code, 0) << tuned.err;
  EXPECT_EQ(result()["frames"], 5);
  EXPECT_EQ(result()["held_out_frames"], 4);
  EXPECT_THAT(tune({"--frames", "4"}).err, HasSubstr("has recorded frames"));
}

TEST_F(TuneCommand, RefusesBadWordsWithOneSentence) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> bad = {
      {{"--repeat", "3"}, "--repeat"},
      {{"--processes", "0"}, "--processes"},
      {{"--max-hover", "nan"}, "\"nan\" is not a number from 0 on"},
      {{"--budget-ms", "-1"}, "\"-1\" is not a number from 0 on"},
      {{"--max-missed", "-1"}, "--max-missed"},
      {{"--lattice", "0"}, "\"0\" is not a number from 0.01 to 100"},
      {{"--question", "contacts"}, "contacts"},
      {{"--frames", "3"}, "3"},
      {{"--most", "1", "--exhaustive"}, "--exhaustive"},
      {{"--deformer", "jelly"}, "jelly"},
      {{"--deformer", "all"}, "is not simulated"},
      {{"--detector", "no-such"}, "unknown detector \"no-such\""},
      {{"--detector", "ffd-aabb", "--question", "triangles"}, "does not answer the question"}};
  for (const auto& [words, sentence] : bad) {
    const Outcome refused = tune(words);
    EXPECT_EQ(refused.exit_code, 2) << words[1];
    EXPECT_THAT(refused.err, HasSubstr(sentence));
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  }
  scene_ = "default";
  EXPECT_THAT(tune({}).err, HasSubstr("\"default\" is a suite"));
  scene_ = "paper-rabbit";
  EXPECT_THAT(tune({"--lattice", "2"}).err, HasSubstr("is simulated"));
  scene_ = "hard-vertex-face";
  EXPECT_THAT(tune({}).err, HasSubstr("its frames are cases"));
}

}  // namespace
}  // namespace contactcheck::tune
