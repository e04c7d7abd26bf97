#include "reference/run/goals.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;
using Kind = SuiteGoal::Kind;

Json run(const std::string& scene, const std::string& detector, double cold, double hot) {
  const auto phases = [](double ms) { return Json{{"frame", ms}, {"contact_frame", 2.0 * ms}}; };
  return {{"scene", scene},
          {"detector", detector},
          {"status", "ok"},
          {"message", ""},
          {"contact_frames", 10},
          {"levels", {{"triangle", {{"truth", 4000}}}}},
          {"time_ms", {{"question", "triangles"}, {"cold", phases(cold)}, {"hot", phases(hot)}}},
          {"speedup", Json::object()}};
}

Json ratio(double value) { return {{"ratio", value}, {"low", value - 1.0}, {"high", value + 2.0}}; }

Json sample() {
  Json fast = run("s", "fast", 2.0, 1.0);
  fast["speedup"]["triangles"]["slow"] = {
      {"cold", ratio(5.0)}, {"hot", ratio(8.0)}, {"contact_frames", nullptr}};
  Json gone = run("s", "gone", 1.0, 1.0);
  gone["status"] = "absent";
  gone["message"] = "not built";
  Json untimed = run("s", "untimed", 1.0, 1.0);
  untimed["time_ms"] = {{"prepare", 1.0}};
  return {{"runs", {fast, run("t", "fast", 3.0, 1.5), run("s", "slow", 10.0, 8.0), gone, untimed}}};
}

SuiteGoal goal(Kind kind, const std::string& other, const std::string& part) {
  SuiteGoal g;
  g.name = "g";
  g.scene = "s";
  g.detector = "fast";
  g.kind = kind;
  g.other = other;
  g.part = part;
  g.at_least = 5.0;
  return g;
}

Json measured(const SuiteGoal& g) { return measure_goals({g}, sample()).at(0); }

TEST(Goals, OverADetectorAreItsSpeedUpWithTheInterval) {
  const Json cold = measured(goal(Kind::kOver, "slow", "cold"));
  EXPECT_EQ(cold.at("measured"), 5.0);
  EXPECT_EQ(cold.at("low"), 4.0);
  EXPECT_EQ(cold.at("high"), 7.0);
  EXPECT_EQ(cold.at("over"), "slow");
  EXPECT_EQ(cold.at("at_least"), 5.0);
  EXPECT_EQ(cold.at("met"), true);
  EXPECT_EQ(measured(goal(Kind::kOver, "slow", "hot")).at("measured"), 8.0);
}

TEST(Goals, OverASceneAreTheQuotientOfTheDetectorsOwnTimes) {
  SuiteGoal g = goal(Kind::kOverScene, "t", "cold");
  EXPECT_DOUBLE_EQ(measured(g).at("measured").get<double>(), 2.0 / 3.0);
  EXPECT_EQ(measured(g).at("met"), false);
  g.part = "contact_frames";
  EXPECT_DOUBLE_EQ(measured(g).at("measured").get<double>(), 4.0 / 6.0);
}

TEST(Goals, PerPairAreMicrosecondsOfFramesWithContact) {
  SuiteGoal g = goal(Kind::kPerPair, "", "hot");
  g.at_least.reset();
  g.at_most = 5.0;
  EXPECT_DOUBLE_EQ(measured(g).at("measured").get<double>(), 1e3 * 2.0 / 400.0);
  EXPECT_EQ(measured(g).at("unit"), "us");
  EXPECT_EQ(measured(g).at("met"), true);
  g.part = "cold";
  EXPECT_DOUBLE_EQ(measured(g).at("measured").get<double>(), 1e3 * 4.0 / 400.0);
  EXPECT_EQ(measured(g).at("met"), false);
}

TEST(Goals, ThatCannotBeMeasuredSayWhy) {
  const auto why = [](const SuiteGoal& g) {
    const Json entry = measured(g);
    EXPECT_TRUE(entry.at("measured").is_null());
    EXPECT_TRUE(entry.at("met").is_null());
    return entry.at("why").get<std::string>();
  };
  EXPECT_EQ(why(goal(Kind::kOver, "nobody", "cold")), "nobody did not run in s");
  EXPECT_EQ(why(goal(Kind::kOver, "gone", "cold")), "gone: not built");
  EXPECT_EQ(why(goal(Kind::kOver, "untimed", "cold")),
            "untimed does not answer the question triangles");
  EXPECT_EQ(why(goal(Kind::kOver, "slow", "contact_frames")), "no frame with contact was timed");
  EXPECT_EQ(why(goal(Kind::kOverScene, "u", "cold")), "fast did not run in u");
  SuiteGoal g = goal(Kind::kOverScene, "s", "cold");
  g.detector = "untimed";
  EXPECT_EQ(why(g), "nothing was timed");
}

}  // namespace
}  // namespace contactcheck
