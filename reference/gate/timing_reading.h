// Ratios of times out of results, and whether two runs may be compared by them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reference/gate/policy.h"
#include "reference/gate/row_index.h"
#include "reference/gate/verdict.h"

namespace contactcheck {

/// Why times of one run say nothing about those of the other: another CPU, number of cores,
/// instruction set, compiler, build, or version of a library. Empty when they do.
std::string other_machine(const nlohmann::ordered_json& now, const nlohmann::ordered_json& before);

/// Verdict, what was measured and why. `before`: the baseline, or null.
/// @pre the rule is a timing rule; the row's status is `ok`
/// @throws nlohmann::json::exception when results do not have the schema's fields
Check judge_timing(const Rule& rule, const RowIndex& now, const RowIndex* before,
                   const nlohmann::ordered_json& row);

}  // namespace contactcheck
