// Results written by hand, and policies of one rule to hold against them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "reference/gate/gate.h"

namespace contactcheck::test {

/// As fixtures/results.schema.json wants them. Scene "touch", 8 frames: "exact" (all right, timed,
/// 4 times as fast as "ref" within 5 %), "ref" (timed), "paper" (three contacts missed and two
/// spurious at level cell, most of both in frame 5), "single" (one level, informative), "broken"
/// (ended in an error at frame 4), "lost" (absent). Family "hard-gap", values 0, 1e-9 and 1:
/// "exact". Scene "random-pairs": "exact".
nlohmann::ordered_json sample_results();

/// The row of a scene and detector. @pre there is one
nlohmann::ordered_json& row_of(nlohmann::ordered_json& results, const std::string& scene,
                               const std::string& detector);

/// The policy of one rule "R": `{"rule": "R", ` + rest + `}`, with quotes ' for ".
gate::Policy policy_of(const std::string& rest);

/// Its checks.
std::vector<gate::Check> checks_of(const std::string& rest, const nlohmann::ordered_json& results,
                                   const nlohmann::ordered_json* baseline = nullptr);

/// The only check of a rule about scene "touch" and one detector; `measure` is the rest of the
/// rule.
gate::Check check_of(const std::string& detector, const std::string& measure,
                     const nlohmann::ordered_json& results,
                     const nlohmann::ordered_json* baseline = nullptr);

}  // namespace contactcheck::test
