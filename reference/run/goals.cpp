#include "reference/run/goals.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

/// Why a goal could not be measured, for the report.
class NotMeasured : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

const Json& run_of(const Json& results, const std::string& scene, const std::string& detector) {
  for (const Json& run : results.at("runs")) {
    if (run.at("scene") != scene || run.at("detector") != detector) continue;
    if (run.at("status") != "ok")
      throw NotMeasured(detector + ": " + run.at("message").get<std::string>());
    return run;
  }
  throw NotMeasured(detector + " did not run in " + scene);
}

const Json& times_of(const Json& run) {
  const Json& times = run.at("time_ms");
  if (!times.contains("cold")) throw NotMeasured("nothing was timed");
  return times;
}

double frame_ms(const Json& run, const std::string& part) {
  if (part != "contact_frames") return times_of(run).at(part).at("frame").get<double>();
  const Json& time = times_of(run).at("cold").at("contact_frame");
  if (time.is_null()) throw NotMeasured("no frame with contact was timed");
  return time.get<double>();
}

Json measured_over(const SuiteGoal& goal, const Json& results) {
  run_of(results, goal.scene, goal.other);  // who did not run is named
  const Json& run = run_of(results, goal.scene, goal.detector);
  const std::string question = times_of(run).at("question").get<std::string>();
  const Json& all = run.at("speedup");
  if (!all.contains(question) || !all.at(question).contains(goal.other))
    throw NotMeasured(goal.other + " does not answer the question " + question);
  const Json& ratio = all.at(question).at(goal.other).at(goal.part);
  if (ratio.is_null()) throw NotMeasured("no frame with contact was timed");
  return {{"measured", ratio.at("ratio")},
          {"low", ratio.at("low")},
          {"high", ratio.at("high")},
          {"unit", "x"}};
}

Json measured_over_scene(const SuiteGoal& goal, const Json& results) {
  const double here = frame_ms(run_of(results, goal.scene, goal.detector), goal.part);
  const double there = frame_ms(run_of(results, goal.other, goal.detector), goal.part);
  return {{"measured", here / there}, {"unit", "x"}};
}

// Over frames with contact: time and pairs of both are means over these.
Json measured_per_pair(const SuiteGoal& goal, const Json& results) {
  const Json& run = run_of(results, goal.scene, goal.detector);
  const char* const state = goal.part == "hot" ? "hot" : "cold";
  const Json& ms = times_of(run).at(state).at("contact_frame");
  if (ms.is_null() || !run.at("levels").contains("triangle"))
    throw NotMeasured("no frame with contact was timed");
  const double pairs = run.at("levels").at("triangle").at("truth").get<double>() /
                       run.at("contact_frames").get<double>();
  return {{"measured", 1e3 * ms.get<double>() / pairs}, {"unit", "us"}};
}

Json measured(const SuiteGoal& goal, const Json& results) {
  switch (goal.kind) {
    case SuiteGoal::Kind::kOver:
      return measured_over(goal, results);
    case SuiteGoal::Kind::kOverScene:
      return measured_over_scene(goal, results);
    case SuiteGoal::Kind::kPerPair:
      return measured_per_pair(goal, results);
  }
  throw NotMeasured("");
}

}  // namespace

Json to_json(const SuiteGoal& goal) {
  Json out = {
      {"goal", goal.name}, {"scene", goal.scene}, {"detector", goal.detector}, {"part", goal.part}};
  if (goal.kind == SuiteGoal::Kind::kOver) out["over"] = goal.other;
  if (goal.kind == SuiteGoal::Kind::kOverScene) out["over_scene"] = goal.other;
  if (goal.kind == SuiteGoal::Kind::kPerPair) out["per"] = "pair";
  if (goal.at_least) out["at_least"] = *goal.at_least;
  if (goal.at_most) out["at_most"] = *goal.at_most;
  return out;
}

SuiteGoal goal_from(const Json& json) {
  SuiteGoal goal;
  json.at("goal").get_to(goal.name);
  json.at("scene").get_to(goal.scene);
  json.at("detector").get_to(goal.detector);
  json.at("part").get_to(goal.part);
  if (json.contains("over")) {
    goal.kind = SuiteGoal::Kind::kOver;
    json.at("over").get_to(goal.other);
  } else if (json.contains("over_scene")) {
    goal.kind = SuiteGoal::Kind::kOverScene;
    json.at("over_scene").get_to(goal.other);
  } else {
    goal.kind = SuiteGoal::Kind::kPerPair;
  }
  if (json.contains("at_least")) goal.at_least = json.at("at_least").get<double>();
  if (json.contains("at_most")) goal.at_most = json.at("at_most").get<double>();
  return goal;
}

Json measure_goals(const std::vector<SuiteGoal>& goals, const Json& results) {
  Json out = Json::array();
  for (const SuiteGoal& goal : goals) {
    Json entry = to_json(goal);
    try {
      entry.update(measured(goal, results));
      const auto value = entry.at("measured").get<double>();
      entry["met"] = goal.at_least ? value >= *goal.at_least : value <= *goal.at_most;
    } catch (const NotMeasured& e) {
      entry.update({{"measured", nullptr}, {"why", e.what()}, {"met", nullptr}});
    }
    out.push_back(std::move(entry));
  }
  return out;
}

}  // namespace contactcheck
