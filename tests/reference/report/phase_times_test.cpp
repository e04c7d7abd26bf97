#include "reference/report/tables/frame_costs.h"

#include <gmock/gmock.h>

namespace contactcheck::report {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

results::Run timed_run(const std::string& scene, const std::string& detector,
                       std::optional<double> map, double update, double query) {
  results::Run run;
  run.scene = scene;
  run.detector = detector;
  run.times.resize(1);
  run.times[0].question = map ? Question::kTriangles : Question::kCells;
  run.times[0].passes = 3;
  results::PhaseTimes& playback = run.times[0].playback;
  playback.map = map;
  playback.update = update;
  playback.query = query;
  run.times[0].cold = playback;
  run.times[0].cold->query = query * 2.0;
  return run;
}

// "mapped" takes less than "lazy" where its mapping is left out.
results::Results results_with_phases() {
  results::Results results;
  results.scenes.resize(2);
  results.scenes[0].id = "a";
  results.scenes[1].id = "b";
  results.runs = {timed_run("a", "mapped", 6.0, 1.0, 2.0), timed_run("a", "lazy", {}, 1.0, 3.0),
                  timed_run("b", "mapped", 2.0, 2.0, 1.0), timed_run("b", "lazy", {}, 3.0, 5.0)};
  return results;
}

std::vector<PhaseMeans> means_in(const results::Results& results, bool cold) {
  return phase_times(results::Index(results), scene_choices(results).at(0), cold);
}

TEST(PhaseTimes, AreMeansOverScenesTheFastestFirst) {
  const std::vector<PhaseMeans> all = means_in(results_with_phases(), false);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].detector, "lazy");
  EXPECT_EQ(all[1].detector, "mapped");
  EXPECT_EQ(all[1].question, Question::kTriangles);
  EXPECT_EQ(all[1].scenes, 2u);
  EXPECT_EQ(all[1].map, 4.0);
  EXPECT_EQ(all[1].update, 1.5);
  EXPECT_EQ(all[1].query, 1.5);
  EXPECT_EQ(all[1].total(), 7.0);
  EXPECT_EQ(all[1].without_map(), 3.0);
}

TEST(PhaseTimes, LazyDetectorHasNoTimeOfMapping) {
  const PhaseMeans lazy = means_in(results_with_phases(), false)[0];
  EXPECT_FALSE(lazy.map);
  EXPECT_EQ(lazy.total(), 6.0);
  EXPECT_EQ(lazy.without_map(), 6.0);
}

TEST(PhaseTimes, ColdCachesHaveTheirOwn) {
  results::Results results = results_with_phases();
  const std::vector<PhaseMeans> all = means_in(results, true);
  EXPECT_EQ(all[0].query, 3.0);
  EXPECT_EQ(all[1].query, 8.0);
  for (results::Run& run : results.runs) run.times[0].cold.reset();
  EXPECT_THAT(means_in(results, true), IsEmpty());
}

TEST(PhaseTimes, OnlyScenesInWhichADetectorWasTimedCount) {
  results::Results results = results_with_phases();
  results.runs[0].status = results::Status::kError;
  results.runs[1].times.clear();
  std::vector<PhaseMeans> all = means_in(results, false);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].detector, "mapped");
  EXPECT_EQ(all[0].scenes, 1u);
  EXPECT_EQ(all[0].map, 2.0);
  EXPECT_EQ(all[1].query, 5.0);
  for (results::Run& run : results.runs) run.times.clear();
  EXPECT_THAT(means_in(results, false), IsEmpty());
}

TEST(PhaseTimes, AreATableToo) {
  const TitledTable table = phase_times_table(means_in(results_with_phases(), false));
  EXPECT_EQ(table.columns.size(), 8u);
  EXPECT_THAT(
      table.rows,
      ElementsAre(ElementsAre("lazy", "cells", "2", "-", "2.00", "4.00", "6.00", "3"),
                  ElementsAre("mapped", "triangles", "2", "4.00", "1.50", "1.50", "7.00", "3")));
}

TEST(PhaseTimes, TableSaysWhereFramesWereLeftOut) {
  results::Results results = results_with_phases();
  for (results::Run& run : results.runs) run.frames = run.times[0].timed_frames = 60;
  results.runs[1].times[0].timed_frames = 4;
  results.runs[1].times[0].passes = 1;
  EXPECT_THAT(
      phase_times_table(means_in(results, false)).rows[0],
      ElementsAre("lazy", "cells", "2", "-", "2.00", "4.00", "6.00 (64 of 120 frames)", "1 to 3"));
}

}  // namespace
}  // namespace contactcheck::report
