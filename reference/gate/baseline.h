// Results as the baseline of later gates: what a gate compares, and nothing that points at files.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck {

/// The same schema. Without recordings, cases, times and shares per frame, and episodes; machine,
/// libraries and command stay.
/// @throws nlohmann::json::exception when results do not have the schema's fields
nlohmann::ordered_json baseline_of(const nlohmann::ordered_json& results);

/// As it is written: one line per scene and per row, so that a change of one row is one line of a
/// difference.
std::string baseline_text(const nlohmann::ordered_json& baseline);

/// What another baseline in its place changes, a line each: machine and libraries, rows that are
/// new or gone, statuses, contacts, counts at the finest level; empty when nothing of it changed.
/// Times are not compared.
std::vector<std::string> baseline_changes(const results::Results& before,
                                          const results::Results& now);

}  // namespace contactcheck
