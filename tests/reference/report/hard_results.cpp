#include "tests/reference/report/hard_results.h"

#include <nlohmann/json.hpp>

#include "tests/reference/report/sample_results.h"

namespace contactcheck::test {
namespace {
using Json = nlohmann::ordered_json;

Json family(const std::string& id) {
  return {{"id", id},
          {"title", "Two | plates"},
          {"family",
           {{"parameter", "gap, m"},
            {"values", {"0", "1e-9", "1e-3"}},
            {"origin", "issue 7"},
            {"stresses", "gaps"},
            {"true_pairs", {4, 0, 0}}}}};
}

// A run of the sample, with other answers.
Json run(const std::string& scene, const std::string& detector, const Json& missed,
         const Json& spurious) {
  Json run = sample_results().at("runs").at(0);
  run["scene"] = scene;
  run["detector"] = detector;
  run["per_frame"] = {
      {"level", "triangle"}, {"truth", {4, 0, 0}}, {"missed", missed}, {"spurious", spurious}};
  run["time_ms"]["playback"]["frame"] = 0.25;
  return run;
}

}  // namespace

Json hard_results() {
  Json results = sample_results();
  results["scenes"] = {family("one"), family("two")};
  results["runs"] = {
      run("one", "exact", {0, 0, 0}, {0, 0, 0}),
      run("one", "skin", {0, 0, 0}, {0, 3, 2}),
      {{"scene", "one"},
       {"detector", "crash"},
       {"status", "error"},
       {"message", "signal 11"},
       {"failed_frame", 2}},
      run("two", "exact", {0, 0, 0}, {0, 0, 0}),
      run("two", "skin", {1, 0, 0}, {0, 0, 0}),
      {{"scene", "two"}, {"detector", "crash"}, {"status", "refused"}, {"message", "far"}}};
  results["disagreements"] = Json::array();
  return results;
}

}  // namespace contactcheck::test
