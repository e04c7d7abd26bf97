#include "reference/report/tables/error_spreads.h"

#include <gmock/gmock.h>

namespace contactcheck::report {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

results::Run& add_graded_run(results::Results& results, const std::string& scene,
                             const std::string& detector) {
  results::Run& run = results.runs.emplace_back();
  run.scene = scene;
  run.detector = detector;
  return run;
}

results::Results two_empty_scenes() {
  results::Results results;
  results.scenes.resize(2);
  results.scenes[0].id = "a";
  results.scenes[1].id = "b";
  return results;
}

// Depths of a detector in two scenes.
results::Results with_depths() {
  results::Results results = two_empty_scenes();
  results::Geometry& a = add_graded_run(results, "a", "deep").geometry;
  a.depth_kind = DepthKind::kConvexPair;
  a.depth = {7, 0.004, 0.001, 0.003, {{1e-9, 2e-9, 1}, {1e-7, 2e-7, 1}, {0.002, 0.005, 5}}};
  results::Geometry& b = add_graded_run(results, "b", "deep").geometry;
  b.depth_kind = DepthKind::kConvexPair;
  b.depth = {1, 0.002, 0.002, 0.002, {{0.002, 0.005, 1}}};
  return results;
}

std::vector<ErrorChart> charts_in(const results::Results& results, std::size_t choice) {
  return error_charts(results::Index(results), scene_choices(results).at(choice));
}

std::vector<std::string> titles_of(const std::vector<ErrorChart>& charts) {
  std::vector<std::string> titles;
  for (const ErrorChart& chart : charts) titles.push_back(chart.title);
  return titles;
}

TEST(ErrorCharts, AreOverSeveralScenes) {
  const std::vector<ErrorChart> charts = charts_in(with_depths(), 0);
  ASSERT_THAT(titles_of(charts), ElementsAre("Depth, convex-pair"));
  EXPECT_EQ(charts[0].unit, "mm");
  EXPECT_EQ(charts[0].what, "contacts judged");
  EXPECT_EQ(charts[0].always_zero, "");
  ASSERT_EQ(charts[0].rows.size(), 1u);
  const ErrorRow& row = charts[0].rows[0];
  EXPECT_EQ(row.detector, "deep");
  EXPECT_EQ(row.judged, 8u);
  EXPECT_DOUBLE_EQ(row.mean.value(), 9.0 / 8.0) << "of 7 contacts of 1 mm and one of 2 mm";
  EXPECT_DOUBLE_EQ(row.p95.value(), 3.0) << "of the worst scene";
  EXPECT_DOUBLE_EQ(row.max, 4.0);
}

TEST(ErrorCharts, BinsBelowAMicrometreAreOne) {
  const ErrorRow row = charts_in(with_depths(), 0)[0].rows[0];
  ASSERT_EQ(row.bins.size(), 2u);
  EXPECT_EQ(row.bins[0].from, 0.0);
  EXPECT_EQ(row.bins[0].below, 1e-3);
  EXPECT_EQ(row.bins[0].count, 2u);
  EXPECT_EQ(row.bins[0].share, 2.0 / 8.0);
  EXPECT_DOUBLE_EQ(row.bins[1].from, 2.0);
  EXPECT_DOUBLE_EQ(row.bins[1].below, 4.0) << "the largest error";
  EXPECT_EQ(row.bins[1].count, 6u);
  EXPECT_EQ(row.bins[1].share, 6.0 / 8.0);
}

TEST(ErrorCharts, OfOneSceneAreItsOwn) {
  const ErrorRow row = charts_in(with_depths(), 2)[0].rows[0];
  EXPECT_EQ(row.judged, 1u);
  EXPECT_DOUBLE_EQ(row.max, 2.0);
  EXPECT_EQ(row.bins.size(), 1u);
}

TEST(ErrorCharts, KindsOfDepthDoNotCompare) {
  results::Results results = with_depths();
  results::Geometry& other = add_graded_run(results, "a", "surface").geometry;
  other.depth_kind = DepthKind::kVertexSurface;
  other.depth = {1, 0.5, 0.5, 0.5, {}};
  const std::vector<ErrorChart> charts = charts_in(results, 0);
  EXPECT_THAT(titles_of(charts), ElementsAre("Depth, convex-pair", "Depth, vertex-surface"));
  EXPECT_DOUBLE_EQ(charts[0].rows[0].bins[1].below, 4.0) << "whatever the other chart holds";
  EXPECT_EQ(charts[1].rows[0].kind, DepthKind::kVertexSurface);
}

TEST(ErrorCharts, WhoNeverErrsIsInASentence) {
  results::Results results = two_empty_scenes();
  for (const char* name : {"x", "y", "z"})
    add_graded_run(results, "a", name).geometry.normal_deg = {3, 0.0, 0.0, 0.0, {{0.0, 5.0, 3}}};
  const ErrorChart chart = charts_in(results, 0).at(0);
  EXPECT_EQ(chart.title, "Normal");
  EXPECT_EQ(chart.unit, "\u00b0");
  EXPECT_THAT(chart.rows, IsEmpty());
  EXPECT_EQ(chart.always_zero, "Always 0: x, y and z.");
}

TEST(ErrorCharts, AnglesKeepTheirUnitAndTheirBins) {
  results::Results results = two_empty_scenes();
  results::Geometry& geometry = add_graded_run(results, "a", "turned").geometry;
  geometry.normal_deg = {7, 180.0, 150.0, {}, {{0.0, 5.0, 1}, {175.0, 180.0, 6}}};
  const ErrorRow row = charts_in(results, 0).at(0).rows.at(0);
  EXPECT_EQ(row.mean, 150.0);
  EXPECT_FALSE(row.p95);
  ASSERT_EQ(row.bins.size(), 2u);
  EXPECT_EQ(row.bins[0].below, 5.0);
  EXPECT_EQ(row.bins[1].below, 180.0);
}

TEST(ErrorCharts, SpuriousPairsAreCountedByTheirBins) {
  results::Results results = two_empty_scenes();
  results::Geometry& geometry = add_graded_run(results, "a", "wide").geometry;
  geometry.spurious_distance_max = 0.0015;
  geometry.spurious_distance_histogram = {{0.0001, 0.0002, 3}, {0.001, 0.002, 1}};
  const ErrorChart chart = charts_in(results, 0).at(0);
  EXPECT_EQ(chart.title, "Distance of spurious pairs of triangles");
  const ErrorRow& row = chart.rows.at(0);
  EXPECT_EQ(row.judged, 4u);
  EXPECT_FALSE(row.mean);
  EXPECT_EQ(row.bins.at(0).share, 0.75);
  EXPECT_DOUBLE_EQ(row.bins.at(1).below, 1.5);
}

TEST(ErrorCharts, EveryEpisodeOfHoverIsAPoint) {
  results::Results results = two_empty_scenes();
  for (const char* scene : {"a", "b"}) {
    results::Geometry& geometry = add_graded_run(results, scene, "early").geometry;
    geometry.episodes.resize(2);
    geometry.episodes[0].hover_gap = scene[0] == 'a' ? 0.25 : 0.5;
  }
  const ErrorChart chart = charts_in(results, 0).at(0);
  EXPECT_EQ(chart.title, "Hover");
  EXPECT_EQ(chart.rows.at(0).judged, 2u);
  EXPECT_EQ(chart.rows[0].max, 500.0);
  EXPECT_THAT(chart.rows[0].points, ElementsAre(250.0, 500.0));
}

TEST(ErrorCharts, AreNoneWhereNothingWasJudged) {
  results::Results results = two_empty_scenes();
  add_graded_run(results, "a", "plain");
  add_graded_run(results, "a", "failed").geometry.normal_deg = {3, 1.0, 1.0, 1.0, {}};
  results.runs.back().status = results::Status::kError;
  EXPECT_THAT(charts_in(results, 0), IsEmpty());
}

}  // namespace
}  // namespace contactcheck::report
