#include "tests/reference/report/sample_results.h"

namespace contactcheck::test {

nlohmann::ordered_json sample_results() {
  return nlohmann::ordered_json::parse(R"json({
  "schema": "contactcheck-results/2", "version": "0.1.0", "command": "contactcheck run hello",
  "machine": {"cpu": "A CPU", "cores": 2, "isa": "AVX2", "os": "Debian 12", "compiler": "g++ 12",
              "build": "Release"},
  "libraries": {"eigen": "3.4.0", "fcl": "0.7.0"},
  "timing": {"processes": 5, "one_pass_beyond": 2.0, "seed": 1, "sweep_bytes": 67108864},
  "scenes": [
    {"id": "hello", "title": "Two | one bodies meet", "frames": 60, "time_step": 0.1, "size": 1.5,
     "contact_frames": 13, "cold_frames": [3, 8, 17, 21, 30, 44, 52, 59],
     "truth": {"body": 13, "triangle": 200000, "vertex": "not judged: open"},
     "bodies": [
       {"name": "left", "source": "box", "notes": "3 boundary-edge | open", "vertices": 8,
        "triangles": 12, "cells": 27, "solid": false},
       {"name": "right", "source": "sphere", "notes": "", "vertices": 66, "triangles": 128,
        "cells": 26, "solid": true}]}],
  "runs": [
    {"scene": "hello", "detector": "fcl-aabb", "status": "ok", "message": "",
     "frames": 60, "contact_frames": 13,
     "semantics": {"questions": ["triangles", "body"]}, "options": {}, "recording": "",
     "per_frame": {"level": "triangle", "truth": [], "missed": [], "spurious": []},
     "levels": {
       "body": {"truth": 13, "reported": 13, "hit": 13, "missed": 0, "spurious": 0, "recall": 1.0,
                "spurious_rate": 0.0},
       "triangle": {"truth": 200000, "reported": 200000, "hit": 200000, "missed": 0, "spurious": 0,
                    "recall": 1.0, "spurious_rate": 0.0}},
     "geometry": {"hover_gap_max": 0.0, "late_frames": 0}, "stages": [],
     "time_ms": {"prepare": 12.0, "question": "triangles", "timed_frames": 60,
       "timed_contact_frames": 13, "passes": 5,
       "playback": {"map": 0.25, "update": 0.5, "query": 1.25, "frame": 2.0, "contact_frame": 3.0,
                    "first_frame": 4.0, "cpu": 2.25},
       "cold": {"map": 0.25, "update": 0.75, "query": 2.0, "frame": 3.0, "contact_frame": 3.5,
                "cpu": 3.25}},
     "speedup": {"triangles": {"fcl-aabb": {"playback": {"ratio": 1.0, "low": 1.0, "high": 1.0},
                                            "cold": {"ratio": 1.0, "low": 1.0, "high": 1.0},
                                            "passes": 5}}},
     "memory_bytes": 1048576, "prepared_bytes": 524288, "contact_hash": "0x1"},
    {"scene": "hello", "detector": "ffd-aabb-sphere2+tri", "status": "ok", "message": "",
     "frames": 60, "contact_frames": 13,
     "semantics": {"questions": ["triangles", "body"]}, "options": {}, "recording": "",
     "per_frame": {"level": "triangle", "truth": [], "missed": [], "spurious": []},
     "levels": {
       "body": {"truth": 13, "reported": 15, "hit": 13, "missed": 0, "spurious": 2, "recall": 1.0,
                "spurious_rate": 0.13333333333333333},
       "triangle": {"truth": 200000, "reported": 200001, "hit": 199999, "missed": 1, "spurious": 2,
                    "recall": 0.999995, "spurious_rate": 0.00000999995}},
     "geometry": {"hover_gap_max": 0.0021, "late_frames": -1},
     "stages": [{"name": "hash", "unit": "cell pairs", "in": 900, "out": 30, "missed": 1}],
     "time_ms": {"prepare": 8.0, "question": "triangles", "timed_frames": 60,
       "timed_contact_frames": 0, "passes": 5,
       "playback": {"map": null, "update": 0.125, "query": 0.375, "frame": 0.5,
                    "contact_frame": null, "first_frame": 1.0, "cpu": 0.5},
       "cold": {"map": null, "update": 0.25, "query": 0.5, "frame": 0.75, "contact_frame": null,
                "cpu": 0.75}},
     "speedup": {"triangles": {"fcl-aabb": {"playback": {"ratio": 4.0, "low": 3.5, "high": 4.25},
                                            "cold": {"ratio": 4.0, "low": 3.0, "high": 5.0},
                                            "passes": 5}}},
     "memory_bytes": 524288, "prepared_bytes": 262144, "contact_hash": "0x2"},
    {"scene": "hello", "detector": "fcl-obbrss", "status": "error",
     "message": "scene hello, frame 7, phase query: signal 11 (Segmentation fault) | core",
     "frames": 60, "contact_frames": 13},
    {"scene": "hello", "detector": "embree", "status": "absent", "message": "not built"},
    {"scene": "hello", "detector": "ffd-grid", "status": "refused",
     "message": "body \"left\" has no lattice"}],
  "disagreements": [
    {"scene": "hello", "frame": 17, "detector": "ffd-aabb-sphere2+tri", "level": "triangle",
     "kind": "missed", "case": "cases/0001.json"}]
})json");
}

nlohmann::ordered_json drawn_sample_results(std::size_t count) {
  nlohmann::ordered_json results = sample_results();
  auto scene = results["scenes"][0], run = results["runs"][0];
  for (const char* list : {"scenes", "runs", "disagreements"})
    results[list] = nlohmann::ordered_json::array();
  for (std::size_t i = 1; i <= count; ++i) {
    scene["id"] = run["scene"] = "drawn-7-" + std::to_string(i);
    scene["contact_frames"] = i % 2 == 0 ? 0 : 4;
    scene["drawn"] = {{"seed", 7},
                      {"number", i},
                      {"redrawn", 0},
                      {"happens", "touch"},
                      {"parameters", {{"triangles", 100.0}, {"speed", 0.5}}}};
    results["scenes"].push_back(scene);
    results["runs"].push_back(run);
  }
  return results;
}

}  // namespace contactcheck::test
