// Rules that are judged on any machine: what was answered, not how fast.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reference/gate/policy.h"
#include "reference/gate/row_index.h"
#include "reference/gate/verdict.h"

namespace contactcheck {

/// Verdict, what was measured and why. `before`: the baseline, or null.
/// @pre the rule is no timing rule; the row's status is `ok`, unless the rule is about the status
/// @throws nlohmann::json::exception when results do not have the schema's fields
Check judge_accuracy(const Rule& rule, const RowIndex& now, const RowIndex* before,
                     const nlohmann::ordered_json& row);

/// The same of a scene with random pairs, for a rule about oracle_wrong.
Check judge_oracle(const Rule& rule, const nlohmann::ordered_json& scene);

/// "cannot judge", with a reason.
Check cannot_judge(const Rule& rule, const std::string& reason);

/// The baseline's row of the same scene and detector if it ended well; else null, and `reason` says
/// what is in its place.
const nlohmann::ordered_json* row_before(const RowIndex* before, const nlohmann::ordered_json& row,
                                         std::string& reason);

}  // namespace contactcheck
