#include "reference/report/loss_charts.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reference/report/markdown.h"
#include "reference/results/results_json.h"
#include "tests/reference/report/hard_results.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck::report {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

results::Results sample_losses() { return results::from_json(test::sample_results()); }

results::Run& lossy_run(results::Results& results) { return results.runs[1]; }

results::Stage stage(const std::string& name, std::uint64_t missed) {
  results::Stage stage;
  stage.name = name;
  stage.missed = missed;
  return stage;
}

// The sample's run that errs, a second time in another scene, with other counts.
results::Results two_scenes() {
  results::Results results = sample_losses();
  results.scenes.push_back(results.scenes[0]);
  results.scenes[1].id = "second";
  results::Run run = lossy_run(results);
  run.scene = "second";
  run.levels[Level::kTriangle].missed = 9;
  run.stages = {stage("spheres", 5), stage("hash", 4)};
  results.runs.push_back(run);
  return results;
}

TEST(ErrorsPicture, HasARowForEveryDetectorThatErrs) {
  const std::string svg = errors_picture(sample_losses());
  EXPECT_THAT(
      svg, AllOf(HasSubstr("ffd-aabb-sphere2+tri (triangle)"),
                 HasSubstr("missed 1 of 200000; spurious 2 of 200001"), HasSubstr("scene hello")));
  EXPECT_THAT(svg, Not(HasSubstr("fcl"))) << "right, or without an answer";
}

TEST(ErrorsPicture, SumsOverScenesAndNotOverLevels) {
  results::Results results = two_scenes();
  EXPECT_THAT(errors_picture(results),
              AllOf(HasSubstr("missed 10 of 400000; spurious 4 of 400002"), HasSubstr("2 scenes")));
  results.runs.back().per_frame.level = Level::kBody;
  EXPECT_THAT(errors_picture(results),
              AllOf(HasSubstr("(triangle)"), HasSubstr("(body)"), HasSubstr("spurious 2 of 15")));
}

TEST(ErrorsPicture, IsOfFamiliesOnlyWhereThereIsNothingElse) {
  results::Results results = results::from_json(test::hard_results());
  results.runs[1].levels[Level::kTriangle].missed = 3;
  EXPECT_THAT(errors_picture(results),
              AllOf(HasSubstr("2 families of hard cases"), HasSubstr("skin (triangle)")));
  results.scenes.push_back(sample_losses().scenes[0]);
  EXPECT_EQ(errors_picture(results), "") << "that scene has no run";
}

TEST(ErrorsPicture, LeavesOutWhatIsNoClaim) {
  results::Results results = sample_losses();
  lossy_run(results).levels[Level::kTriangle].informative = true;
  EXPECT_EQ(errors_picture(results), "");
}

TEST(StagesPicture, SaysWhichStageLostHowMany) {
  const std::string one = stages_picture(sample_losses());
  EXPECT_THAT(one, AllOf(HasSubstr(">hash 1 of 200000<"),
                         HasSubstr("ffd-aabb-sphere2+tri: 1 of 200000 true pairs lost in hash")));
  EXPECT_THAT(stages_picture(two_scenes()),
              AllOf(HasSubstr(">hash 5, spheres 5 of 400000<"), HasSubstr("2 scenes")));
}

// Stages cover pairs of triangles: of a run that was judged by bodies alone nobody knows how many.
TEST(StagesPicture, LeavesOutRunsThatWereNotJudgedThere) {
  results::Results results = two_scenes();
  results.runs.back().per_frame.level = Level::kBody;
  EXPECT_THAT(stages_picture(results), HasSubstr(">hash 1 of 200000<"));
}

TEST(StagesPicture, IsNoneWhereNoStageLostAny) {
  results::Results results = sample_losses();
  lossy_run(results).stages[0].missed = 0;
  EXPECT_EQ(stages_picture(results), "");
  lossy_run(results).stages.clear();
  EXPECT_EQ(stages_picture(results), "");
}

TEST(StagesPicture, HasAColourForAnyNumberOfStages) {
  results::Results results = sample_losses();
  lossy_run(results).stages.clear();
  for (int i = 0; i < 20; ++i)
    lossy_run(results).stages.push_back(stage("stage" + std::to_string(i), 1));
  EXPECT_THAT(stages_picture(results),
              AllOf(HasSubstr(">other stages<"), HasSubstr("lost in stage19"),
                    Not(HasSubstr("class=\"s8\""))));
}

TEST(LossCharts, AreFilesOfTheReport) {
  const auto files = report_files(sample_losses());
  for (const char* file : {kErrorsFile, kStagesFile}) {
    EXPECT_TRUE(files.contains(file));
    EXPECT_THAT(files.at("report.md"), HasSubstr(std::string("](") + file + ")"));
  }
  results::Results right = sample_losses();
  right.runs.erase(right.runs.begin() + 1);
  EXPECT_FALSE(report_files(right).contains(kErrorsFile));
  EXPECT_THAT(report_files(right).at("report.md"), Not(HasSubstr("Errors by detector and stage")));
}

TEST(LossCharts, TakeNoMarkupFromResults) {
  results::Results results = sample_losses();
  lossy_run(results).detector = "<script>";
  lossy_run(results).stages[0].name = "<b>";
  for (const std::string& svg : {errors_picture(results), stages_picture(results)}) {
    EXPECT_THAT(svg, HasSubstr("&lt;script&gt;"));
    EXPECT_THAT(svg, AllOf(Not(HasSubstr("<script")), Not(HasSubstr("<b>"))));
  }
}

}  // namespace
}  // namespace contactcheck::report
