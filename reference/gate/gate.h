// The gate: a policy held against results, and against those of an earlier run where there is one.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reference/gate/policy.h"
#include "reference/gate/verdict.h"

namespace contactcheck {

/// Every rule on every row that it is about. A rule whose patterns match nothing is a failure; so
/// is what the baseline has and the results lack. `baseline` may be null: then the rules that need
/// one cannot be judged.
/// @throws nlohmann::json::exception when results do not have the schema's fields
GateResult run_gate(const Policy& policy, const nlohmann::ordered_json& results,
                    const nlohmann::ordered_json* baseline);

}  // namespace contactcheck
