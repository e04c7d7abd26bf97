#include "reference/report/tables/stage_losses.h"

#include <gmock/gmock.h>

namespace contactcheck::report {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

results::Stage counted_stage(const std::string& name, std::uint64_t in, std::uint64_t missed) {
  results::Stage stage;
  stage.name = name;
  stage.unit = "cell pairs";
  stage.in = in;
  stage.out = in / 2;
  stage.missed = missed;
  return stage;
}

results::Run staged_run(const std::string& scene, const std::string& detector, Level level,
                        std::uint64_t truth, std::vector<results::Stage> stages) {
  results::Run run;
  run.scene = scene;
  run.detector = detector;
  run.per_frame.level = level;
  run.levels[level].truth = truth;
  run.stages = std::move(stages);
  return run;
}

// Two scenes, "lossy" and "clean" in either.
results::Results staged_results() {
  results::Results results;
  results.scenes.resize(2);
  results.scenes[0].id = "a";
  results.scenes[1].id = "b";
  results::Stage planes = counted_stage("node-plane", 8, 2);
  planes.visited = 12;
  planes.visited_unit = "planes";
  results.runs = {
      staged_run("a", "lossy", Level::kCell, 10, {counted_stage("hash", 40, 1), planes}),
      staged_run("a", "clean", Level::kTriangle, 10, {counted_stage("hash", 40, 0)}),
      staged_run("b", "lossy", Level::kCell, 6, {counted_stage("hash", 20, 1), planes}),
      staged_run("b", "clean", Level::kTriangle, 6, {counted_stage("hash", 40, 0)})};
  return results;
}

std::vector<DetectorLosses> losses_in(const results::Results& results, std::size_t choice) {
  return stage_losses(results::Index(results), scene_choices(results).at(choice));
}

TEST(StageLosses, AreSumsOverScenes) {
  const std::vector<DetectorLosses> all = losses_in(staged_results(), 0);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].detector, "lossy");
  EXPECT_EQ(all[0].truth, 16u);
  const std::vector<StageLoss> losses = all[0].losses();
  ASSERT_EQ(losses.size(), 2u);
  EXPECT_EQ(losses[0].stage, "hash");
  EXPECT_EQ(losses[0].missed, 2u);
  EXPECT_EQ(losses[0].share, 2.0 / 16.0);
  EXPECT_EQ(losses[1].missed, 4u);
  EXPECT_THAT(all[1].losses(), IsEmpty());
  EXPECT_THAT(
      stage_losses_table(all).rows,
      ElementsAre(ElementsAre("lossy", "hash", "cell pairs", "60", "30", "-", "2"),
                  ElementsAre("lossy", "node-plane", "cell pairs", "16", "8", "24 planes", "4"),
                  ElementsAre("clean", "hash", "cell pairs", "80", "40", "-", "0")));
}

TEST(StageLosses, OfOneSceneAreItsOwn) {
  const std::vector<DetectorLosses> all = losses_in(staged_results(), 2);
  EXPECT_EQ(all[0].truth, 6u);
  EXPECT_EQ(all[0].losses()[0].share, 1.0 / 6.0);
}

TEST(StageLosses, AreToldInWords) {
  const std::vector<DetectorLosses> all = losses_in(staged_results(), 0);
  EXPECT_THAT(loss_sentences(all, 12),
              ElementsAre("lossy loses 6: 2 in hash and 4 in node-plane."));
  EXPECT_THAT(loss_sentences(all, 0), IsEmpty());
  EXPECT_THAT(losing_stages(all), ElementsAre("hash", "node-plane"));
  EXPECT_EQ(no_loss_sentence(all), "Without a loss in any stage: clean.");
  EXPECT_EQ(no_loss_sentence({all[0]}), "");
  EXPECT_EQ(no_loss_sentence({all[1]}), "No stage of any detector lost a true contact here.");
}

// What is judged by pairs of bodies alone may stop at the first contact: the others are no loss.
TEST(StageLosses, LeaveOutRunsThatWereJudgedByBodiesAlone) {
  results::Results results = staged_results();
  results.runs[2].per_frame.level = Level::kBody;
  const std::vector<DetectorLosses> all = losses_in(results, 0);
  EXPECT_EQ(all[0].truth, 10u);
  EXPECT_THAT(loss_sentences(all, 12),
              ElementsAre("lossy loses 3: 1 in hash and 2 in node-plane."));
  for (results::Run& run : results.runs) run.per_frame.level = Level::kBody;
  EXPECT_EQ(no_loss_sentence(losses_in(results, 0)),
            "No detector with stages was judged by pairs of triangles here.");
}

TEST(StageLosses, CellsAndTrianglesAddUp) {
  results::Results results = staged_results();
  results.runs[2].per_frame.level = Level::kTriangle;
  results.runs[2].levels[Level::kTriangle].truth = 7;
  EXPECT_EQ(losses_in(results, 0)[0].truth, 17u);
}

TEST(StageLosses, StagesOfOtherUnitsAreLinesOfTheirOwn) {
  results::Results results = staged_results();
  results.runs[2].stages[0].unit = "triangle pairs";
  const DetectorLosses lossy = losses_in(results, 0)[0];
  EXPECT_EQ(lossy.stages.size(), 3u);
  ASSERT_EQ(lossy.losses().size(), 2u);
  EXPECT_EQ(lossy.losses()[0].missed, 2u) << "one bar per name";
}

TEST(StageLosses, RunsThatFailedOrHaveNoStagesDoNotCount) {
  results::Results results = staged_results();
  results.runs[0].status = results::Status::kError;
  results.runs[1].stages.clear();
  const std::vector<DetectorLosses> all = losses_in(results, 0);
  EXPECT_EQ(all[0].truth, 6u);
  EXPECT_EQ(all[1].truth, 6u);
}

// Nobody then knows the share; the pairs are still said.
TEST(StageLosses, ShareOfNothingIsNone) {
  const auto all = stage_losses(std::vector<const results::Run*>{});
  EXPECT_THAT(all, IsEmpty());
  const results::Run run = staged_run("a", "odd", Level::kCell, 0, {counted_stage("hash", 4, 3)});
  EXPECT_EQ(stage_losses({&run})[0].losses()[0].share, 0.0);
}

}  // namespace
}  // namespace contactcheck::report
