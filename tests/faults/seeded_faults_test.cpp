// Detectors broken on purpose, and the comparison that must see each of them as what it is.
#include <gmock/gmock.h>

#include <numeric>
#include <set>

#include "reference/judge/accuracy.h"
#include "reference/judge/hover.h"
#include "reference/process/float_environment.h"
#include "tests/faults/broken_detectors.h"
#include "tests/support/approach_scene.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Optional;

constexpr std::size_t kFrames = 24;

// Two spheres in lattices of 3 x 3 x 3 cells meet head-on, sink 0.15 m into each other and part.
scene::Scene spheres() {
  const auto ball = test::make_body("", test::sphere_mesh(Vec3::Zero(), 0.5, 2), {3, 3, 3}).shape;
  return test::approach_scene(ball, ball, {{0.0, 1.4}, {1.2, 0.85}, {2.4, 1.4}}, 0.05, 0.03,
                              kFrames, 0.1, {Level::kBody, Level::kTriangle});
}

struct Pass {
  scene::Scene scene;
  judge::JudgedScene judged;
  results::Run result;
  judge::AccuracyOutcome outcome;

  Pass(scene::Scene s, Detector& detector, bool hover = false) : scene(std::move(s)) {
    process::SharedProgress page;
    process::ProgressWriter progress(&page);
    judged = judge::judge_scene(scene, progress);
    judge::JudgingTools tools(judged);
    outcome = judge::run_accuracy(tools, 0, detector, progress, result);
    if (!hover) return;
    judge::measure_hover_gaps(tools, 0, detector, progress, result);
  }
  const results::LevelCounts& at(Level level) const { return result.levels.at(level); }
  std::set<std::string> disagreements() const {
    std::set<std::string> out;
    for (const judge::Disagreement& d : outcome.disagreements) out.insert(d.level + " " + d.kind);
    return out;
  }
};

std::string truthful_hash() {
  test::TruthfulDetector honest;
  return Pass(spheres(), honest).result.contact_hash;
}

TEST(SeededFault, NoneIsPerfect) {
  test::TruthfulDetector honest;
  const Pass pass(spheres(), honest, true);
  EXPECT_GT(pass.at(Level::kTriangle).truth, 50u);
  EXPECT_EQ(pass.at(Level::kTriangle).hit, pass.at(Level::kTriangle).truth);
  EXPECT_TRUE(pass.at(Level::kTriangle).perfect());
  EXPECT_TRUE(pass.at(Level::kBody).perfect());
  EXPECT_THAT(pass.disagreements(), IsEmpty());
  EXPECT_THAT(pass.result.geometry.late_frames, Optional(0));
  EXPECT_THAT(pass.result.geometry.hover_gap_max, Optional(testing::Lt(1e-6)));
}

TEST(SeededFault, EveryTenthPairDroppedIsMissedAndNothingElse) {
  test::DropsEveryTenth detector;
  const Pass pass(spheres(), detector);
  std::uint64_t dropped = 0;
  for (const oracle::Truth& t : pass.judged.truth) dropped += (t.surface.triangles.size() + 9) / 10;
  EXPECT_GT(dropped, 10u);
  EXPECT_EQ(pass.at(Level::kTriangle).missed, dropped);
  EXPECT_EQ(pass.at(Level::kTriangle).spurious, 0u);
  EXPECT_TRUE(pass.at(Level::kBody).perfect());
  EXPECT_THAT(pass.disagreements(), ElementsAre("triangle missed"));
}

TEST(SeededFault, OnePairThatIsNotThereIsSpuriousAndEarly) {
  // Triangle 0 looks away from the other body in one of the two; they never meet.
  const ElementPair pair{0, 1, 0, 0};
  test::Invents detector(pair);
  const Pass pass(spheres(), detector);
  for (const oracle::Truth& t : pass.judged.truth)
    ASSERT_FALSE(std::binary_search(t.surface.triangles.begin(), t.surface.triangles.end(), pair));
  EXPECT_EQ(pass.at(Level::kTriangle).spurious, kFrames);
  EXPECT_EQ(pass.at(Level::kTriangle).missed, 0u);
  EXPECT_THAT(pass.disagreements(), ElementsAre("triangle spurious"))
      << "its answer to the question body is right";
  ASSERT_EQ(pass.result.geometry.episodes.size(), 1u);
  const auto first_true = static_cast<long>(*pass.result.geometry.episodes[0].first_true);
  EXPECT_GT(first_true, 0);
  EXPECT_THAT(pass.result.geometry.late_frames, Optional(-first_true));
  const auto& d = pass.outcome.disagreements.front();
  EXPECT_EQ(d.frame, 0u);
  EXPECT_EQ(d.pair, pair);
}

TEST(SeededFault, SwappedIdsAreMissedAndSpuriousInEqualNumber) {
  test::SwapsIds detector;
  const Pass pass(spheres(), detector);
  const results::LevelCounts& counts = pass.at(Level::kTriangle);
  EXPECT_EQ(counts.truth, counts.reported) << "counts alone see nothing";
  EXPECT_GT(counts.missed, 0u);
  EXPECT_EQ(counts.missed, counts.spurious);
  EXPECT_TRUE(pass.at(Level::kBody).perfect());
  EXPECT_THAT(pass.disagreements(), ElementsAre("triangle missed", "triangle spurious"));
}

TEST(SeededFault, AnswerOfThePreviousFrameIsOneFrameLate) {
  test::AnswersLate detector;
  const Pass pass(spheres(), detector);
  EXPECT_THAT(pass.result.geometry.late_frames, Optional(1));
  EXPECT_EQ(pass.at(Level::kBody).missed, 1u);
  EXPECT_EQ(pass.at(Level::kBody).spurious, 1u);
  EXPECT_GT(pass.at(Level::kTriangle).missed, 0u);
  EXPECT_GT(pass.at(Level::kTriangle).spurious, 0u);
  EXPECT_THAT(pass.disagreements(),
              ElementsAre("body missed", "body spurious", "triangle missed", "triangle spurious"));
}

// Bare boxes (their vertices are exact): apart in frames 0 to 2, touching in 3 to 5, overlapping
// in 6 to 8.
scene::Scene touching_boxes() {
  const auto box = make_bare_shape(test::box_mesh(Vec3::Constant(-0.5), Vec3::Constant(0.5), 2));
  return test::approach_scene(box, box,
                              {{0, 1.25}, {2, 1.25}, {3, 1.0}, {5, 1.0}, {6, 0.875}, {8, 0.875}},
                              0.25, 0.125, 9, 1.0, {Level::kBody, Level::kTriangle});
}

TEST(SeededFault, TouchingThatIsNotCountedIsMissedInTouchingFramesAlone) {
  test::TruthfulDetector honest;
  EXPECT_THAT(Pass(touching_boxes(), honest).at(Level::kBody).truth, 6u);
  test::MissesTouching detector;
  const Pass pass(touching_boxes(), detector);
  EXPECT_EQ(pass.at(Level::kBody).missed, 3u);
  EXPECT_EQ(pass.at(Level::kBody).spurious, 0u);
  std::vector<bool> misses;
  for (std::uint64_t missed : pass.result.per_frame.missed) misses.push_back(missed > 0);
  EXPECT_THAT(misses, ElementsAre(false, false, false, true, true, true, false, false, false));
  EXPECT_EQ(pass.at(Level::kTriangle).spurious, 0u);
  EXPECT_THAT(pass.result.geometry.late_frames, Optional(3));
  EXPECT_THAT(pass.disagreements(), ElementsAre("body missed", "triangle missed"));
}

TEST(SeededFault, RepeatedPairsAreHarmless) {
  test::Repeats detector;
  const Pass pass(spheres(), detector);
  EXPECT_TRUE(pass.at(Level::kTriangle).perfect());
  EXPECT_TRUE(pass.at(Level::kBody).perfect());
  EXPECT_EQ(pass.result.contact_hash, truthful_hash());
}

TEST(SeededFault, SilenceToTheBodyQuestionIsMissedAtBodyLevel) {
  test::LiesAboutBodies detector(false);
  const Pass pass(spheres(), detector);
  EXPECT_TRUE(pass.at(Level::kTriangle).perfect());
  EXPECT_EQ(pass.at(Level::kBody).missed, pass.result.contact_frames);
  EXPECT_THAT(pass.disagreements(), ElementsAre("body missed"));
}

TEST(SeededFault, FalseAlarmInTheBodyQuestionIsSpuriousAtBodyLevel) {
  test::LiesAboutBodies detector(true);
  const Pass pass(spheres(), detector);
  EXPECT_TRUE(pass.at(Level::kTriangle).perfect());
  EXPECT_EQ(pass.at(Level::kBody).spurious, kFrames - pass.result.contact_frames);
  EXPECT_THAT(pass.disagreements(), ElementsAre("body spurious"));
}

template <typename Broken>
std::string error_of(Broken&& detector) {
  try {
    Pass pass(spheres(), detector);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(SeededFault, ExceptionPassesThroughWithItsText) {
  EXPECT_EQ(error_of(test::Throws()), "stack overflow in tree");
}

TEST(SeededFault, NamesThatDoNotExistAreErrorsAndNotLookedUp) {
  EXPECT_EQ(error_of(test::Invents({0, 1, 5, 128})),
            "frame 0: the answer names triangle 128 of body \"moving\", which has 128");
  EXPECT_EQ(error_of(test::Invents({0, 7, 5, 5})), "frame 0: the answer names body 7 of 2 bodies");
  EXPECT_EQ(error_of(test::Invents({1, 1, 5, 6})),
            "frame 0: the answer names body \"moving\" in contact with itself");
}

#if defined(__SSE__)
TEST(SeededFault, SpoiledArithmeticIsNamedAndRestored) {
  const process::FloatEnvironmentGuard outer;
  test::SpoilsArithmetic detector;
  const Pass pass(spheres(), detector, true);
  EXPECT_THAT(pass.result.float_environment,
              ElementsAre("query changed rounding mode, flush-to-zero"));
  EXPECT_TRUE(pass.at(Level::kTriangle).perfect());
  EXPECT_THAT(pass.result.geometry.hover_gap_max, Optional(testing::Lt(1e-6)));
  EXPECT_EQ(outer.check_and_restore(), "") << "what comes next would be wrong";
}
#endif

}  // namespace
}  // namespace contactcheck
