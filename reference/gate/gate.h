// The gate: applies a policy to results, compared with a baseline if there is one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/gate/policy.h"
#include "reference/gate/verdict.h"
#include "reference/results/results.h"

namespace contactcheck::gate {

// These checks keep a gate from ignoring rules that match nothing, and rows that only the baseline
// has.

/// The rule's name in checks against the baseline's rows.
inline constexpr const char* kBaselineRule = "everything that the baseline has";

/// The rule's name in the check that fails because too many rules cannot be judged.
inline constexpr const char* kOpenRule = "rules can judge what they are about";

struct RowName {
  std::string scene, detector;
};

/// A failure for every pattern of the rule that matches none of `rows`, the rows that the rule is
/// about; one failure for a rule without rows. Messages name what `results` contain instead.
std::vector<Check> idle_patterns(const Rule& rule, const std::vector<RowName>& rows,
                                 const results::Results& results);

/// A failure if more rules cannot judge some of their rows than the policy allows.
std::optional<Check> too_many_open(const Policy& policy, const GateResult& result);

/// A failure for every scene and row of the baseline that the results lack, for every row that was
/// `ok` in the baseline and is not now, and for what the baseline judged of a row and the results
/// do not: levels, questions, frames, depths, normals, times within steps, a driven motion; also
/// where the row declares another measure of contact than in the baseline, as a wider margin.
std::vector<Check> lost_rows(const results::Index& now, const results::Results& before);

/// What the baseline's row was judged by and this one is not, and where it declares another measure
/// of contact: sentences. Both are `ok`.
std::vector<std::string> judged_no_more(const results::Run& now, const results::Run& before);

/// Applies every rule to every row that it is about. Failures are also: a rule whose patterns match
/// nothing, scenes and rows that only the baseline has, and more rules that cannot be judged than
/// the policy allows (but see Policy::advisory_times). `baseline` may be null. @throws InputError
/// if it is and a rule needs one
GateResult run_gate(const Policy& policy, const results::Results& results,
                    const results::Results* baseline);

}  // namespace contactcheck::gate
