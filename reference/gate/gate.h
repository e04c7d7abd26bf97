// The gate: a policy held against results, and against those of an earlier run where there is one.
#pragma once

#include "reference/gate/policy.h"
#include "reference/gate/verdict.h"
#include "reference/results/results.h"

namespace contactcheck {

/// Every rule on every row that it is about. A rule whose patterns match nothing is a failure; so
/// is what the baseline has and the results lack, and more rules that cannot judge than the policy
/// allows. `baseline` may be null. @throws InputError when it is and a rule needs one
GateResult run_gate(const Policy& policy, const results::Results& results,
                    const results::Results* baseline);

}  // namespace contactcheck
