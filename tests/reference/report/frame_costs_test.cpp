#include "reference/report/tables/frame_costs.h"

#include <gtest/gtest.h>

namespace contactcheck::report {
namespace {

using Counts = std::vector<std::pair<std::size_t, std::uint64_t>>;
using Points = std::vector<std::pair<double, double>>;

results::Results timed_results() {
  results::Results results;
  results::Scene& scene = results.scenes.emplace_back();
  scene.id = "scaling-contact-16";
  scene.bodies.resize(2);
  scene.bodies[0].triangles = 12;
  scene.bodies[1].triangles = 30;
  scene.separation = {0.5, 0.05, 0.005, 0.005, 0.0, 0.0};
  results::Run& run = results.runs.emplace_back();
  run.scene = scene.id;
  run.detector = "ffd-lazy";
  run.times.emplace_back();
  run.times[0].playback.frame = 3.0;
  run.times[0].cold.emplace().frame = 4.0;
  run.per_frame.truth = {0, 0, 0, 0, 2, 3};
  run.per_frame.missed = {0, 0, 0, 0, 1, 0};
  run.per_frame.spurious = {0, 7, 0, 0, 0, 2};
  run.per_frame.frame_ms = {{1.0, 2.0, 3.0, 5.0, std::nullopt, 10.0}};
  return results;
}

SceneCosts costs_of_first(const results::Results& results) {
  return scene_costs(results::Index(results), results.scenes[0]);
}

TEST(FrameCosts, TellSizeSeriesAndErrorsOfFrames) {
  const SceneCosts costs = costs_of_first(timed_results());
  EXPECT_EQ(costs.series, "contact");
  EXPECT_EQ(costs.triangles, 42u);
  ASSERT_EQ(costs.detectors.size(), 1u);
  EXPECT_EQ(costs.detectors[0].cold, 4.0);
  EXPECT_EQ(costs.detectors[0].playback, 3.0);
  EXPECT_EQ(costs.detectors[0].missed, (Counts{{4, 1}}));
  EXPECT_EQ(costs.detectors[0].spurious, (Counts{{1, 7}, {5, 2}}));
}

TEST(FrameCosts, NamesWithoutASizeAreTheirOwnSeries) {
  for (const auto& [id, series] : {std::pair("contact", "contact"), std::pair("pile-20", "pile"),
                                   std::pair("a2", "a2"), std::pair("12", "12")}) {
    results::Results results = timed_results();
    results.scenes[0].id = id;
    EXPECT_EQ(costs_of_first(results).series, series);
  }
}

TEST(FrameCosts, FramesAboutEquallyFarHaveOneMedian) {
  const SceneCosts costs = costs_of_first(timed_results());
  EXPECT_EQ(costs.distance, (std::vector{500.0, 50.0, 5.0, 5.0, 0.0, 0.0}));
  EXPECT_EQ(costs.detectors[0].by_distance, (Points{{5.0, 4.0}, {50.0, 2.0}, {500.0, 1.0}}));
}

TEST(FrameCosts, FramesThatTouchStandApart) {
  results::Results results = timed_results();
  const auto touching_of = [&] { return costs_of_first(results).detectors[0].touching; };
  ASSERT_TRUE(touching_of());
  EXPECT_EQ(touching_of()->frames, 1u);  // the other one was not timed
  results.runs[0].per_frame.frame_ms->at(4) = 20.0;
  EXPECT_EQ(touching_of()->low, 10.0);
  EXPECT_EQ(touching_of()->median, 15.0);
  EXPECT_EQ(touching_of()->high, 20.0);
  results.scenes[0].separation[4] = results.scenes[0].separation[5] = 0.1;
  EXPECT_FALSE(touching_of());
}

TEST(FrameCosts, TruthIsThatOfTheLevelWithMostContacts) {
  results::Results results = timed_results();
  results::Run bodies = results.runs[0];
  bodies.detector = "bullet-cl";
  bodies.per_frame.truth = {0, 0, 0, 0, 1, 1};
  results.runs.insert(results.runs.begin(), bodies);
  EXPECT_EQ(costs_of_first(results).truth, (std::vector<std::uint64_t>{0, 0, 0, 0, 2, 3}));
}

TEST(FrameCosts, WithoutTimesOrDistancesThereAreErrorsAlone) {
  results::Results results = timed_results();
  results.scenes[0].separation.clear();
  EXPECT_TRUE(costs_of_first(results).detectors[0].by_distance.empty());
  results.runs[0].times[0].cold.reset();
  EXPECT_FALSE(costs_of_first(results).detectors[0].cold);
  EXPECT_EQ(costs_of_first(results).detectors[0].playback, 3.0);
  results.runs[0].times.clear();
  const SceneCosts untimed = costs_of_first(results);
  EXPECT_FALSE(untimed.detectors[0].playback);
  EXPECT_TRUE(untimed.detectors[0].frame_ms.empty());
  EXPECT_EQ(untimed.detectors[0].missed, (Counts{{4, 1}}));
  results.runs[0].status = results::Status::kError;
  EXPECT_TRUE(costs_of_first(results).detectors.empty());
}

}  // namespace
}  // namespace contactcheck::report
