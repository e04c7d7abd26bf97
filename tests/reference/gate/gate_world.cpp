#include "tests/reference/gate/gate_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "reference/results/results_json.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::test {
namespace {
using Json = nlohmann::ordered_json;

constexpr const char* kHead = R"json({
  "schema": "contactcheck-results/2", "version": "0.1.0",
  "command": "contactcheck run scenes/touch.json hard-gap --pairs 64 --seed 7 --processes=7",
  "machine": {"cpu": "A CPU", "cores": 2, "isa": "AVX2", "os": "Debian 12", "compiler": "g++ 12",
              "build": "Release"},
  "libraries": {"eigen": "3.4.0", "fcl": "0.7.0"},
  "timing": {"processes": 7, "one_pass_beyond": 0, "seed": 1, "sweep_bytes": 0},
  "scenes": [
    {"id": "touch", "title": "Two boxes", "frames": 8, "time_step": 0.1, "size": 1,
     "contact_frames": 3,
     "truth": {"body": 3, "triangle": 40, "cell": 40}, "truth_hash": "0xa", "bodies": [],
     "cold_frames": [1, 3, 4, 6]},
    {"id": "hard-gap", "title": "Gaps", "frames": 3, "time_step": 0, "size": 1, "contact_frames": 1,
     "truth": {"triangle": 1}, "truth_hash": "0xb", "bodies": [],
     "family": {"parameter": "gap, m", "values": ["0", "1e-9", "1"], "origin": "derived",
                "stresses": "gaps", "true_pairs": [1, 0, 0]}},
    {"id": "random-pairs", "title": "Random pairs", "frames": 64, "time_step": 0, "size": 1,
     "contact_frames": 30, "truth": {"triangle": 30}, "truth_hash": "0xc", "bodies": [],
     "pairs": {"count": 64, "seed": 7, "touching": 30, "per_kind": {},
               "rational": {"checked": 64, "oracle_wrong": 0}}}],
  "known_defects": {"defects": [], "readings": [], "changed": [], "not_shown": [], "unlisted": []},
  "runs": [], "disagreements": [
    {"scene": "touch", "frame": 2, "detector": "paper", "level": "body", "kind": "spurious",
     "case": "cases/0001.json"}]
})json";

constexpr const char* kExact = R"json(
    {"scene": "touch", "detector": "exact", "status": "ok", "message": "", "frames": 8,
     "contact_frames": 3, "semantics": {"levels": ["body", "triangle"]}, "options": {},
     "recording": "recordings/touch.ccr",
     "per_frame": {"level": "triangle", "truth": [0,0,0,10,20,10,0,0], "missed": [0,0,0,0,0,0,0,0],
                   "spurious": [0,0,0,0,0,0,0,0],
                   "covered_length_fraction": [null,null,null,1,1,1,null,null],
                   "frame_ms": [1,1,1,1,1,1,1,1]},
     "levels": {
       "body": {"truth": 3, "reported": 3, "hit": 3, "missed": 0, "spurious": 0, "recall": 1,
                "spurious_rate": 0},
       "triangle": {"truth": 40, "reported": 40, "hit": 40, "missed": 0, "spurious": 0, "recall": 1,
                    "spurious_rate": 0}},
     "not_judged": {"vertex": "not judged: open"},
     "geometry": {"missed_length": 0, "covered_length_fraction": 1, "spurious_distance_max": 0,
       "depth_kind": "none", "depth_judged": 0, "depth_error_mean": null, "depth_error_max": null,
       "depth_error_p95": null, "normal_judged": 0, "normal_error_deg_mean": null,
       "normal_error_deg_p95": null, "normal_error_deg_max": null, "hover_gap_max": 0,
       "late_frames": 0, "episodes": []},
     "stages": [{"name": "boxes", "unit": "triangle pairs", "in": 900, "out": 50, "missed": 0},
                {"name": "triangles", "unit": "triangle pairs", "in": 50, "out": 40, "missed": 0}],
     "time_ms": {"prepare": 1, "question": "triangles", "timed_frames": 8,
       "timed_contact_frames": 3, "passes": 7,
       "playback": {"map": 0.1, "update": 0.3, "query": 0.6, "frame": 1, "contact_frame": 2,
                    "first_frame": 3, "cpu": 1},
       "cold": {"map": 0.4, "update": 1.2, "query": 2.4, "frame": 4, "contact_frame": 5, "cpu": 4}},
     "speedup": {"triangles": {"ref": {
       "playback": {"ratio": 4, "low": 3.8, "high": 4.2},
       "cold": {"ratio": 2, "low": 1.9, "high": 2.1},
       "contact_frames": {"ratio": 3, "low": 2.9, "high": 3.1},
       "without_map": {"ratio": 5, "low": 4.9, "high": 5.1}, "passes": 7, "interval": "95 %",
       "reference_options": {}}}},
     "memory_bytes": 1000, "prepared_bytes": 5, "contact_hash": "0xa"})json";

constexpr const char* kOthers = R"json([
    {"scene": "touch", "detector": "paper", "status": "ok", "message": "", "frames": 8,
     "contact_frames": 3, "semantics": {"levels": ["body", "cell"]}, "options": {"bounds": "paper"},
     "recording": "recordings/touch.ccr",
     "per_frame": {"level": "cell", "truth": [0,0,0,10,20,10,0,0], "missed": [0,0,0,1,0,2,0,0],
                   "spurious": [0,0,0,0,0,2,0,0],
                   "covered_length_fraction": [null,null,null,0.9,1,0.8,null,null],
                   "frame_ms": []},
     "levels": {
       "body": {"truth": 3, "reported": 4, "hit": 3, "missed": 0, "spurious": 1, "recall": 1,
                "spurious_rate": 0.25},
       "cell": {"truth": 40, "reported": 20, "hit": 37, "missed": 3, "spurious": 2, "recall": 0.925,
                "spurious_rate": 0.1}},
     "geometry": {"missed_length": 0.5, "covered_length_fraction": 0.9,
       "spurious_distance_max": 0.25, "depth_kind": "convex-pair", "depth_judged": 9,
       "depth_error_mean": 0.01, "depth_error_max": 0.03, "depth_error_p95": 0.02,
       "normal_judged": 9, "normal_error_deg_mean": 10, "normal_error_deg_p95": 20,
       "normal_error_deg_max": 30, "hover_gap_max": 0.125, "late_frames": -2, "episodes": []},
     "stages": [{"name": "spheres", "unit": "cell pairs", "in": 90, "out": 60, "missed": 1},
                {"name": "node-plane", "unit": "cell pairs", "in": 60, "out": 20, "missed": 2}],
     "time_ms": {"prepare": 1}, "memory_bytes": 2000, "prepared_bytes": 5, "contact_hash": "0xd"},
    {"scene": "touch", "detector": "single", "status": "ok", "message": "", "frames": 8,
     "contact_frames": 3, "semantics": {"levels": [], "informative": ["vertex"]}, "options": {},
     "recording": "", "per_frame": {"level": "", "truth": [], "missed": [], "spurious": []},
     "levels": {"vertex": {"truth": 4, "reported": 2, "hit": 1, "missed": 3, "spurious": 1,
                "recall": 0.25, "spurious_rate": 0.5, "informative": true}},
     "geometry": {"missed_length": null, "covered_length_fraction": null,
       "spurious_distance_max": null, "depth_kind": "none", "depth_error_max": null,
       "depth_error_p95": null, "normal_error_deg_max": null, "hover_gap_max": null,
       "late_frames": null},
     "stages": [], "time_ms": {"prepare": 1}, "memory_bytes": 10, "prepared_bytes": 5,
     "contact_hash": "0xe"},
    {"scene": "touch", "detector": "broken", "status": "error", "message": "signal 11 in a query",
     "frames": 8, "failed_frame": 4},
    {"scene": "touch", "detector": "lost", "status": "absent", "message": "not built"}])json";

// As "exact" in "touch", elsewhere.
Json exact_in(const std::string& scene, std::size_t frames, const std::string& hash) {
  Json row = Json::parse(kExact);
  row["scene"] = scene;
  row["frames"] = frames;
  row["contact_frames"] = 1;
  row["contact_hash"] = hash;
  row["time_ms"] = {{"prepare", 1}};
  row.erase("speedup");
  row["per_frame"] = {{"level", "triangle"},
                      {"truth", std::vector<int>(frames, 0)},
                      {"missed", std::vector<int>(frames, 0)},
                      {"spurious", std::vector<int>(frames, 0)}};
  return row;
}

Json reference_row() {
  Json row = Json::parse(kExact);
  row["detector"] = "ref";
  for (auto& [part, ratio] : row["speedup"]["triangles"]["ref"].items())
    if (ratio.contains("ratio")) ratio = {{"ratio", 1.0}, {"low", 1.0}, {"high", 1.0}};
  return row;
}

}  // namespace

Json sample_results() {
  Json out = Json::parse(kHead);
  out["runs"].push_back(Json::parse(kExact));
  out["runs"].push_back(reference_row());
  for (const Json& row : Json::parse(kOthers)) out["runs"].push_back(row);
  out["runs"].push_back(exact_in("hard-gap", 3, "0xb"));
  out["runs"].push_back(exact_in("random-pairs", 64, "0xc"));
  return out;
}

Json& row_of(Json& results, const std::string& scene, const std::string& detector) {
  for (Json& row : results.at("runs"))
    if (row.at("scene") == scene && row.at("detector") == detector) return row;
  throw std::out_of_range(scene + " " + detector);
}

gate::Policy policy_of(const std::string& rest) {
  std::string rule = "{'rule': 'R', " + rest + "}";
  std::replace(rule.begin(), rule.end(), '\'', '"');
  const Scratch scratch;
  return gate::read_policy(
      scratch.write("policy.json", R"({"schema": "contactcheck-policy/1", "id": "p", "title": "t",)"
                                   R"("rules": [)" +
                                       rule + "]}"));
}

std::vector<gate::Check> checks_of(const std::string& rest, const Json& results,
                                   const Json* baseline) {
  const results::Results now = results::from_json(results);
  const results::Results before = baseline == nullptr ? now : results::from_json(*baseline);
  return gate::run_gate(policy_of(rest), now, baseline == nullptr ? nullptr : &before).checks;
}

gate::Check check_of(const std::string& detector, const std::string& measure, const Json& results,
                     const Json* baseline) {
  const auto checks = checks_of(
      "'scenes': ['touch'], 'detectors': ['" + detector + "'], " + measure, results, baseline);
  EXPECT_EQ(checks.size(), 1u);
  return checks.empty() ? gate::Check{} : checks.front();
}

}  // namespace contactcheck::test
