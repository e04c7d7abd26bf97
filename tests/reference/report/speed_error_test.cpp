#include "reference/report/tables/speed_error.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <random>

#include "reference/results/results_json.h"
#include "tests/reference/report/sample_results.h"

namespace contactcheck::report {
namespace {

using Json = nlohmann::ordered_json;
using test::sample_results;
using testing::ElementsAre;
using testing::Field;

SpeedError speed_chart(const Json& json) {
  const results::Results results = results::from_json(json);
  return speed_error(results::Index(results));
}

// The sample's two good runs, in a further scene.
Json two_scenes_json() {
  Json results = sample_results();
  results["scenes"].push_back(results["scenes"][0]);
  results["scenes"][1]["id"] = "second";
  for (int i : {0, 1}) {
    Json run = results["runs"][i];
    run["scene"] = "second";
    results["runs"].push_back(run);
  }
  return results;
}

auto detectors_are(const char* a, const char* b) {
  return ElementsAre(Field(&SpeedErrorPoint::detector, a), Field(&SpeedErrorPoint::detector, b));
}

TEST(SpeedError, HasTheNumbersOfTheResults) {
  const SpeedError chart = speed_chart(sample_results());
  EXPECT_EQ(chart.scenes, "scene hello");
  ASSERT_THAT(chart.points, detectors_are("fcl-aabb", "ffd-aabb-sphere2+tri"));
  const SpeedErrorPoint& p = chart.points[1];
  EXPECT_EQ(p.ms, 0.5);
  EXPECT_EQ(p.question, Question::kTriangles);
  EXPECT_EQ(p.level, Level::kTriangle);
  EXPECT_EQ(p.truth, 200000);
  EXPECT_EQ(p.missed, 1);
  EXPECT_EQ(p.reported, 200001);
  EXPECT_EQ(p.spurious, 2);
  EXPECT_DOUBLE_EQ(p.error, 2.0 / 200001.0) << "the worse of 1 in 200000 and 2 in 200001";
}

TEST(SpeedError, WeighsTimesByFramesAndSumsCounts) {
  Json results = two_scenes_json();
  results["runs"][5]["frames"] = 20;
  results["runs"][5]["time_ms"]["playback"]["frame"] = 10.0;
  const SpeedError chart = speed_chart(results);
  EXPECT_EQ(chart.scenes, "all 2 scenes");
  EXPECT_DOUBLE_EQ(chart.points[0].ms, (60 * 2.0 + 20 * 10.0) / 80);
  EXPECT_EQ(chart.points[0].truth, 400000);
}

TEST(SpeedError, RunsThatWereNotTimedColdAreLeftOutThere) {
  Json json = sample_results();
  json["runs"][0]["time_ms"].erase("cold");
  const results::Results results = results::from_json(json);
  const SpeedError chart = SpeedErrorCharts(results::Index(results)).chart({.cold = true});
  ASSERT_EQ(chart.points.size(), 1u);
  EXPECT_EQ(chart.points[0].ms, 0.75);
  EXPECT_EQ(chart.left_out[0].why, "not timed cold");
}

TEST(SpeedError, FrontIsWhatNoOtherBeats) {
  std::mt19937 random(3);
  const Question questions[] = {Question::kTriangles, Question::kBody};
  for (int round = 0; round < 200; ++round) {
    std::vector<SpeedErrorPoint> points(1 + random() % 12);
    for (SpeedErrorPoint& p : points) {
      p.ms = static_cast<double>(1 + random() % 6);  // few values: there are ties
      p.error = 0.1 * static_cast<double>(random() % 4);
      p.question = questions[random() % 2];
    }
    mark_front(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      bool beaten = false;
      for (std::size_t j = 0; j < points.size(); ++j) {
        const auto &p = points[i], &q = points[j];
        const bool no_worse = q.ms <= p.ms && q.error <= p.error && q.question == p.question;
        // Of equals the first one stands for all.
        beaten = beaten || (no_worse && (q.ms < p.ms || q.error < p.error || j < i));
      }
      EXPECT_EQ(points[i].on_front, !beaten) << "round " << round << ", point " << i;
    }
  }
}

}  // namespace
}  // namespace contactcheck::report
