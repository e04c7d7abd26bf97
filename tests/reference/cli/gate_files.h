// Results, a baseline and a policy for the gate, in a folder.
#pragma once

#include <string>

#include "tests/reference/gate/gate_world.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::test {

/// A policy of these rules, which are JSON objects with commas between them.
inline std::string policy_text(const std::string& rules) {
  return R"({"schema": "contactcheck-policy/1", "id": "own", "title": "Of a test", "rules": [)" +
         rules + "]}";
}

/// Nothing missed, nothing spurious, the truth's contacts, those of the baseline, no slower than
/// it.
inline std::string sample_policy() {
  return policy_text(R"(
    {"rule": "none missed", "scenes": ["touch"], "detectors": ["exact"], "measure": "missed",
     "at_most": 0},
    {"rule": "none spurious", "scenes": ["touch"], "detectors": ["exact"], "measure": "spurious",
     "at_most": 0},
    {"rule": "same contacts", "scenes": ["*"], "detectors": ["exact"], "measure": "contact_hash",
     "unchanged": true},
    {"rule": "as fast as it was", "scenes": ["touch"], "detectors": ["exact"],
     "measure": "slowdown", "question": "triangles", "reference": "ref", "at_most": 1.1})");
}

/// DIR/results.json, DIR/baseline.json (the same) and DIR/policy.json.
inline void write_gate_files(const Scratch& scratch) {
  scratch.write("results.json", sample_results().dump());
  scratch.write("baseline.json", sample_results().dump());
  scratch.write("policy.json", sample_policy());
}

}  // namespace contactcheck::test
