// End to end from script to gap: two boxes in undeformed lattices, whose first reports have a
// closed form.
#include <gtest/gtest.h>

#include "core/detect/registry.h"
#include "reference/adapters/register.h"
#include "reference/judge/accuracy.h"
#include "reference/judge/hover.h"
#include "tests/faults/broken_detectors.h"
#include "tests/support/approach_scene.h"
#include "tests/support/shapes.h"

namespace contactcheck::judge {
namespace {

constexpr double kPadding = 0.1, kSize = 1.0;
constexpr double kTolerance = 2e-6 * kSize;  // the bisection's, and rounding

// The moving box's centre is at 1.53 - 0.05 per frame; its surface touches the other's at 1, and
// its lattice, which sticks out by the padding, at 1.2. Frame 7 is the first below 1.2, frame 11
// the first below 1. The shift across keeps nodes off the planes of the other's cells.
scene::Scene boxes() {
  const auto box = test::make_body("", test::box_mesh(Vec3::Constant(-0.5), Vec3::Constant(0.5), 3),
                                   {3, 3, 3}, kPadding)
                       .shape;
  return test::approach_scene(box, box, {{0.0, 1.53}, {16.0, 0.73}}, 0.07, 0.05, 16, 1.0,
                              {Level::kBody});
}

results::Run measured_hover(const scene::Scene& scene, Detector& detector) {
  process::SharedProgress page;
  process::ProgressWriter progress(&page);
  const JudgedScene judged = judge_scene(scene, progress);
  results::Run result;
  JudgingTools tools(judged);
  run_accuracy(tools, 0, detector, progress, result);
  measure_hover_gaps(tools, 0, detector, progress, result);
  return result;
}

results::Run measured_hover(const scene::Scene& scene, const std::string& name) {
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  adapters::register_reference_detectors(catalog);
  return measured_hover(scene, *catalog.make(catalog.parse(name)));
}

TEST(HoverGap, OfFfdGridIsTwicePadding) {
  const results::Run result = measured_hover(boxes(), "ffd-grid");
  ASSERT_EQ(result.geometry.episodes.size(), 1u);
  EXPECT_EQ(result.geometry.episodes[0].first_reported, 7u);
  EXPECT_EQ(result.geometry.episodes[0].first_true, 11u);
  EXPECT_EQ(result.geometry.late_frames, -4);
  ASSERT_TRUE(result.geometry.hover_gap_max);
  EXPECT_NEAR(*result.geometry.hover_gap_max, 2.0 * kPadding * kSize, kTolerance);
}

TEST(HoverGap, OfFfdAabbIsZeroForBoxes) {
  const results::Run result = measured_hover(boxes(), "ffd-aabb");
  EXPECT_EQ(result.geometry.late_frames, 0);
  ASSERT_TRUE(result.geometry.hover_gap_max);
  EXPECT_NEAR(*result.geometry.hover_gap_max, 0.0, kTolerance);
}

TEST(HoverGap, OfAnExactDetectorIsZero) {
  for (const char* name : {"fcl-aabb", "ffd-aabb-sphere2+tri"}) {
    const results::Run result = measured_hover(boxes(), name);
    EXPECT_EQ(result.geometry.late_frames, 0) << name;
    ASSERT_TRUE(result.geometry.hover_gap_max) << name;
    EXPECT_NEAR(*result.geometry.hover_gap_max, 0.0, kTolerance) << name;
  }
}

TEST(HoverGap, OfARecordingIsTheDistanceInTheFirstReportedFrame) {
  scene::Scene scene = boxes();
  scene.recorded = test::recorded_frames(scene);
  scene.motions.clear();
  const results::Run result = measured_hover(scene, "ffd-grid");
  ASSERT_TRUE(result.geometry.hover_gap_max);
  EXPECT_NEAR(*result.geometry.hover_gap_max, 1.53 - 7 * 0.05 - 1.0, 1e-9);
}

// It was judged by surfaces wherever a scene did not list containment: all of it was spurious.
TEST(HoverGap, DetectorOfSolidsIsJudgedByContainmentWhereOnlyBodiesAreListed) {
  const auto ball = test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.5, 1), {2, 2, 2}).shape;
  const auto shell = test::make_body("", test::sphere_mesh(Vec3::Zero(), 2.0, 1), {2, 2, 2}).shape;
  const scene::Scene scene =
      test::approach_scene(shell, ball, {{0.0, 0.0}}, 0, 0, 3, 1.0, {Level::kBody});
  test::ReportsFirstTwo solids(true), surfaces(false);
  const results::Run right = measured_hover(scene, solids), wrong = measured_hover(scene, surfaces);
  EXPECT_EQ(right.levels.at(Level::kBody).truth, 3u);
  EXPECT_TRUE(right.levels.at(Level::kBody).perfect());
  ASSERT_EQ(right.geometry.episodes.size(), 1u);
  EXPECT_EQ(right.geometry.episodes[0].first_true, 0u);
  EXPECT_EQ(right.geometry.hover_gap_max, 0.0);
  EXPECT_EQ(wrong.levels.at(Level::kBody).spurious, 3u);
  ASSERT_TRUE(wrong.geometry.hover_gap_max);
  EXPECT_GT(*wrong.geometry.hover_gap_max, 0.5);
}

TEST(HoverGap, DetectorOfSolidsIsToldWhereContainmentIsNotJudged) {
  TriangleMesh open = test::sphere_mesh(Vec3::Zero(), 2.0, 1);
  open.triangles.pop_back();
  const auto ball = test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.5, 1), {2, 2, 2}).shape;
  const scene::Scene scene = test::approach_scene(test::make_body("", open, {2, 2, 2}).shape, ball,
                                                  {{0.0, 0.0}}, 0, 0, 1, 1.0, {Level::kBody});
  test::ReportsFirstTwo solids(true), surfaces(false);
  const results::Run run = measured_hover(scene, solids);
  ASSERT_EQ(run.notes.size(), 1u);
  EXPECT_TRUE(run.notes[0].starts_with(
      "containment not judged: open (body \"resting\", frame 0, edge of vertices "));
  EXPECT_TRUE(measured_hover(scene, surfaces).notes.empty());
}

TEST(HoverGap, OfAContactFromTheFirstFrameIsTheDistanceThere) {
  scene::Scene scene = boxes();
  scene.motions[1].path.position[0].keys = {{0.0, 1.15}};
  scene.frames = 2;
  const results::Run result = measured_hover(scene, "ffd-grid");
  ASSERT_EQ(result.geometry.episodes.size(), 1u);
  EXPECT_EQ(result.geometry.episodes[0].first_reported, 0u);
  EXPECT_EQ(result.geometry.episodes[0].late_frames, std::nullopt);
  ASSERT_TRUE(result.geometry.hover_gap_max);
  EXPECT_NEAR(*result.geometry.hover_gap_max, 0.15, 1e-9);
}

TEST(HoverGap, IsNullWithoutAReport) {
  scene::Scene scene = boxes();
  scene.motions[1].path.position[0].keys = {{0.0, 1.5}};
  const results::Run result = measured_hover(scene, "ffd-grid");
  EXPECT_TRUE(result.geometry.episodes.empty());
  EXPECT_EQ(result.geometry.hover_gap_max, std::nullopt);
  EXPECT_EQ(result.geometry.late_frames, std::nullopt);
}

}  // namespace
}  // namespace contactcheck::judge
