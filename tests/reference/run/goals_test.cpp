#include "reference/run/goals.h"

#include <gtest/gtest.h>

namespace contactcheck {
namespace {

using results::Goal, results::MeasuredGoal, results::Run;

Run run(const std::string& scene, const std::string& detector, double cold, double hot) {
  const auto phases = [](double ms) {
    results::PhaseTimes times;
    times.frame = ms;
    times.contact_frame = 2.0 * ms;
    return times;
  };
  Run out;
  out.scene = scene;
  out.detector = detector;
  out.contact_frames = 10;
  out.levels[Level::kTriangle].truth = 4000;
  out.times = {{Question::kTriangles, 1, 1, 1, phases(cold), phases(hot)}};
  return out;
}

Ratio ratio(double value) { return {value, value - 1.0, value + 2.0}; }

results::Results sample() {
  Run fast = run("s", "fast", 2.0, 1.0);
  fast.speedup[Question::kTriangles]["slow"] = {ratio(5.0), ratio(8.0), {}, {}, {}};
  Run gone = run("s", "gone", 1.0, 1.0);
  gone.status = results::Status::kAbsent;
  gone.message = "not built";
  Run untimed = run("s", "untimed", 1.0, 1.0);
  untimed.times.clear();
  results::Results out;
  out.runs = {fast, run("t", "fast", 3.0, 1.5), run("s", "slow", 10.0, 8.0), gone, untimed};
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
  const MeasuredGoal cold = measured(over("slow", "cold"));
  EXPECT_EQ(cold.measured, 5.0);
  EXPECT_EQ(cold.low, 4.0);
  EXPECT_EQ(cold.high, 7.0);
  EXPECT_EQ(cold.over, "slow");
  EXPECT_EQ(cold.at_least, 5.0);
  EXPECT_EQ(cold.met, true);
  EXPECT_EQ(measured(over("slow", "hot")).measured, 8.0);
}

TEST(Goals, OverASceneAreTheQuotientOfTheDetectorsOwnTimes) {
  Goal g = over_scene("t", "cold");
  EXPECT_DOUBLE_EQ(measured(g).measured.value(), 2.0 / 3.0);
  EXPECT_EQ(measured(g).met, false);
  g.part = "contact_frames";
  EXPECT_DOUBLE_EQ(measured(g).measured.value(), 4.0 / 6.0);
}

TEST(Goals, PerPairAreMicrosecondsOfFramesWithContact) {
  Goal g = goal("hot");
  g.per = "pair";
  g.at_least.reset();
  g.at_most = 5.0;
  EXPECT_DOUBLE_EQ(measured(g).measured.value(), 1e3 * 2.0 / 400.0);
  EXPECT_EQ(measured(g).unit, "us");
  EXPECT_EQ(measured(g).met, true);
  g.part = "cold";
  EXPECT_DOUBLE_EQ(measured(g).measured.value(), 1e3 * 4.0 / 400.0);
  EXPECT_EQ(measured(g).met, false);
}

TEST(Goals, ThatCannotBeMeasuredSayWhy) {
  const auto why = [](const Goal& g) {
    const MeasuredGoal entry = measured(g);
    EXPECT_FALSE(entry.measured);
    EXPECT_FALSE(entry.met);
    return entry.why;
  };
  EXPECT_EQ(why(over("nobody", "cold")), "nobody did not run in s");
  EXPECT_EQ(why(over("gone", "cold")), "gone: not built");
  EXPECT_EQ(why(over("untimed", "cold")), "untimed does not answer the question triangles");
  EXPECT_EQ(why(over("slow", "contact_frames")), "no frame with contact was timed");
  EXPECT_EQ(why(over_scene("u", "cold")), "fast did not run in u");
  Goal g = over_scene("s", "cold");
  g.detector = "untimed";
  EXPECT_EQ(why(g), "nothing was timed");
}

}  // namespace
}  // namespace contactcheck
