// The gate: applies a policy to results, compared with those of an earlier run where there is one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/gate/policy.h"
#include "reference/gate/verdict.h"
#include "reference/results/results.h"

namespace contactcheck::gate {

// Without these checks a gate would ignore rules that match nothing, and rows that a run lacks and
// its baseline has.

/// The rule's name in checks against the baseline's rows.
inline constexpr const char* kBaselineRule = "everything that the baseline has";

/// The rule's name in the check that too many rules cannot judge.
inline constexpr const char* kOpenRule = "rules can judge what they are about";

struct RowName {
  std::string scene, detector;
};

/// A failure for every pattern of the rule that matches none of `rows`, which are those that the
/// rule is about; one failure for a rule without any row. They name what `results` have instead.
std::vector<Check> idle_patterns(const Rule& rule, const std::vector<RowName>& rows,
                                 const results::Results& results);

/// A failure where more rules cannot judge some of their rows than the policy allows.
std::optional<Check> too_many_open(const Policy& policy, const GateResult& result);

/// A failure for every scene and every row of the baseline that the results lack, and for every row
/// that ended well in the baseline and does not now.
std::vector<Check> lost_rows(const results::Index& now, const results::Results& before);

/// Every rule on every row that it is about. A rule whose patterns match nothing is a failure; so
/// is what the baseline has and the results lack, and more rules that cannot judge than the policy
/// allows (but see Policy::advisory_times). `baseline` may be null. @throws InputError when it is
/// and a rule needs one
GateResult run_gate(const Policy& policy, const results::Results& results,
                    const results::Results* baseline);

}  // namespace contactcheck::gate
