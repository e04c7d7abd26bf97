#include "tests/reference/reproduce/sample_run.h"

#include <utility>

#include "tests/reference/reproduce/sample_paper.h"

namespace contactcheck::test {

reproduce::PaperTables paper_of_our_methods() {
  std::string text = sample_paper_text();
  for (const auto& [word, method] :
       {std::pair{"\"none\"", "\"ffd-aabb\""}, std::pair{"\"one\"", "\"ffd-aabb-sphere\""},
        std::pair{"\"two\"", "\"ffd-aabb-sphere2\""}})
    while (text.find(word) != std::string::npos) text = replaced(text, word, method);
  return tables_of(text);
}

Json sample_step_ms(const SampleTimes& times) {
  const double others = times.mss + times.cell + times.response;
  Json totals = Json::array();
  for (const double test : times.test_by_repeat) totals.push_back(others + test);
  Json out = Json::parse(R"({"steps": 4})");
  out["repeats"] = times.test_by_repeat.size();
  out["mss"] = times.mss;
  out["cell"] = times.cell;
  out["test"] = times.test_by_repeat.at(1);
  out["response"] = times.response;
  out["total"] = totals.at(1);
  out["test_by_repeat"] = times.test_by_repeat;
  out["total_by_repeat"] = totals;
  return out;
}

Json sample_run(const std::string& detector, const Json& step_ms, const std::string& hash,
                int missed) {
  Json run = Json::parse(R"({"scene": "paper-s", "detector": "", "status": "ok",
      "per_frame": {"level": "cell"},
      "levels": {"cell": {"truth": 20, "reported": 20, "missed": 0, "spurious": 7, "recall": 1.0}},
      "contact_hash": "", "stages": []})");
  run["detector"] = detector;
  run["levels"]["cell"]["missed"] = missed;
  run["levels"]["cell"]["recall"] = static_cast<double>(20 - missed) / 20;
  run["contact_hash"] = hash;
  run["step_ms"] = step_ms;
  return run;
}

Json sample_closed_loop() {
  return Json::parse(R"({"error": "", "steps": 120,
      "levels": {"body": {"recall": 1.0}, "cell": {"recall": 0.5}},
      "hover_at_rest_max": 0.0123, "hover_at_rest_mean": 0.0045, "deepest_penetration": null,
      "energy_gain": 0.25, "last_speed": 0.5, "tunnelling_events": 3})");
}

Json sample_results() {
  return Json::parse(R"({"version": "1.2.3", "command": "contactcheck reproduce",
      "machine": {"cpu": "a cpu", "cores": 2, "isa": "avx2", "os": "an os"},
      "scenes": [{"id": "paper-s", "frames": 60, "contact_frames": 41, "truth": {"cell": 20},
                  "bodies": [{"vertices": 11, "triangles": 16, "cells": 3},
                             {"vertices": 11, "triangles": 16, "cells": 3}],
                  "simulation": {"driver": "x", "step": 0.02, "every": 2}}],
      "runs": []})");
}

Json sample_reproduction_results() {
  const Json one = sample_step_ms({.test_by_repeat = {5, 6, 7}});
  const Json two_safe = sample_step_ms({.test_by_repeat = {4, 4, 4}});
  const Json two_paper = sample_step_ms({.test_by_repeat = {2, 2, 2}});
  Json results = sample_results();
  results["runs"] = {sample_run("ffd-aabb-sphere:bounds=safe", one, "0xa", 0),
                     sample_run("ffd-aabb-sphere2:bounds=safe", two_safe, "0xa", 0),
                     sample_run("ffd-aabb-sphere", one, "0xb", 3),
                     sample_run("ffd-aabb-sphere2", two_paper, "0xc", 5)};
  for (const auto& [i, pairs] : {std::pair{0, 40}, std::pair{1, 10}}) {
    Json& stages = results["runs"][i]["stages"];
    stages = Json::parse(R"([{"name": "sphere1", "in": 99}, {"name": "hash", "in": 0}])");
    stages[1]["in"] = pairs;
  }
  return results;
}

}  // namespace contactcheck::test
