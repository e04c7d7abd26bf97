#include "reference/suite/measured_goals.h"

#include <gtest/gtest.h>

namespace contactcheck::suite {
namespace {

using results::Goal, results::MeasuredGoal, results::Run;

Run run(const std::string& scene, const std::string& detector, double playback, double cold) {
  const auto phases = [](double ms) {
    results::PhaseTimes times;
    times.frame = ms;
    times.contact_frame = 2.0 * ms;
    return times;
  };
  Run out;
  out.scene = scene;
  out.detector = detector;
  out.per_frame.level = Level::kTriangle;
  out.per_frame.truth = {1000, 300, 0, 500};
  out.times = {{Question::kTriangles, 4, 2, 3, phases(playback), {}, phases(cold)}};
  return out;
}

results::Ratio ratio(double value) { return {value, value - 1.0, value + 2.0}; }

results::Results sample() {
  Run fast = run("s", "fast", 2.0, 1.0);
  fast.speedup[Question::kTriangles]["slow"] = {ratio(5.0), ratio(8.0), {}, {}, 3, {}};
  fast.speedup[Question::kTriangles]["other"] = {ratio(5.0), {}, {}, {}, 3, {}};
  Run gone = run("s", "gone", 1.0, 1.0);
  gone.status = results::Status::kAbsent;
  gone.message = "not built";
  Run untimed = run("s", "untimed", 1.0, 1.0);
  untimed.times.clear();
  results::Results out;
  out.scenes.resize(1);
  out.scenes[0].id = "s";
  out.scenes[0].cold_frames = {1, 2};
  out.runs = {fast,
              run("t", "fast", 3.0, 1.5),
              run("s", "slow", 10.0, 8.0),
              run("s", "other", 1.0, 1.0),
              gone,
              untimed};
  return out;
}

Goal goal(const std::string& part) {
  Goal g;
  g.goal = "g";
  g.scene = "s";
  g.detector = "fast";
  g.part = part;
  g.at_least = 5.0;
  return g;
}

Goal over(const std::string& other, const std::string& part) {
  Goal g = goal(part);
  g.over = other;
  return g;
}

Goal over_scene(const std::string& scene, const std::string& part) {
  Goal g = goal(part);
  g.over_scene = scene;
  return g;
}

MeasuredGoal measured(const Goal& g) { return measure_goals({g}, sample()).at(0); }

TEST(Goals, OverADetectorAreItsSpeedUpWithTheInterval) {
  const MeasuredGoal playback = measured(over("slow", "playback"));
  EXPECT_EQ(playback.measured, 5.0);
  EXPECT_EQ(playback.low, 4.0);
  EXPECT_EQ(playback.high, 7.0);
  EXPECT_EQ(playback.over, "slow");
  EXPECT_EQ(playback.at_least, 5.0);
  EXPECT_EQ(playback.met, true);
  EXPECT_EQ(measured(over("slow", "cold")).measured, 8.0);
}

TEST(Goals, OverASceneAreTheQuotientOfTheDetectorsOwnTimes) {
  Goal g = over_scene("t", "playback");
  EXPECT_DOUBLE_EQ(measured(g).measured.value(), 2.0 / 3.0);
  EXPECT_EQ(measured(g).met, false);
  g.part = "cold";
  EXPECT_DOUBLE_EQ(measured(g).measured.value(), 1.0 / 1.5);
  g.part = "contact_frames";
  EXPECT_DOUBLE_EQ(measured(g).measured.value(), 4.0 / 6.0);
}

// Of a playback the first frame is left out, and of the cold frames {1, 2} one has contact.
TEST(Goals, PerPairAreMicrosecondsOfTheTimedFramesWithContact) {
  Goal g = goal("playback");
  g.per = "pair";
  g.at_least.reset();
  g.at_most = 10.0;
  EXPECT_DOUBLE_EQ(measured(g).measured.value(), 1e3 * 4.0 / 400.0);
  EXPECT_EQ(measured(g).unit, "us");
  EXPECT_EQ(measured(g).met, true);
  g.at_most = 6.0;
  EXPECT_EQ(measured(g).met, false);
  g.part = "cold";
  EXPECT_DOUBLE_EQ(measured(g).measured.value(), 1e3 * 2.0 / 300.0);
}

TEST(Goals, ThatCannotBeMeasuredSayWhy) {
  const auto why = [](const Goal& g) {
    const MeasuredGoal entry = measured(g);
    EXPECT_FALSE(entry.measured);
    EXPECT_FALSE(entry.met);
    return entry.why;
  };
  EXPECT_EQ(why(over("nobody", "playback")), "nobody did not run in s");
  EXPECT_EQ(why(over("gone", "playback")), "gone: not built");
  EXPECT_EQ(why(over("untimed", "playback")), "untimed does not answer the question triangles");
  EXPECT_EQ(why(over("slow", "contact_frames")), "no frame with contact was timed");
  EXPECT_EQ(why(over("other", "cold")), "it was not timed cold");
  EXPECT_EQ(why(over_scene("u", "playback")), "fast did not run in u");
  Goal g = over_scene("s", "playback");
  g.detector = "untimed";
  EXPECT_EQ(why(g), "nothing was timed");
}

}  // namespace
}  // namespace contactcheck::suite
