// RunResult <-> results.json (schema contactcheck-results/1).
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reference/compare/run_result.h"
#include "reference/compare/speedup.h"

namespace contactcheck {

/// Without times, except prepare.
nlohmann::ordered_json to_json(const RunResult& run);
/// Completes the JSON of an `ok` run with its times and speed-ups.
void add_times(const RunTimes& times, nlohmann::ordered_json& run);
nlohmann::ordered_json to_json(const Disagreement& disagreement);
nlohmann::ordered_json levels_to_json(const std::map<Level, LevelCounts>& levels,
                                      const Semantics& semantics);

/// "0x0123456789abcdef".
std::string hex(std::uint64_t value);

}  // namespace contactcheck
