// Rules that are judged on any machine: what was answered, not how fast.
#pragma once

#include <optional>
#include <string>

#include "core/types/semantics.h"
#include "reference/gate/policy.h"
#include "reference/gate/verdict.h"
#include "reference/results/results.h"

namespace contactcheck::gate {

/// Verdict, what was measured and why. `before`: the baseline, or null.
/// @pre not null where needs_baseline(rule); the rule is no timing rule; the row's status is `ok`,
/// unless the rule is about the status
Check judge_accuracy(const Rule& rule, const results::Index& now, const results::Index* before,
                     const results::Run& row);

/// The same of a scene with random pairs, for a rule about oracle_wrong.
Check judge_oracle(const Rule& rule, const results::Scene& scene);

/// The level that a rule looks at in this row: its own, or the finest claimed and judged; none
/// when no level of the row was judged.
std::optional<Level> level_of(const Rule& rule, const results::Run& row);

/// "cannot judge", with a reason.
Check cannot_judge(const Rule& rule, const std::string& reason);

/// The baseline's row of the same scene and detector if it ended well; else null, and `reason` says
/// what is in its place.
const results::Run* row_before(const results::Index& before, const results::Run& row,
                               std::string& reason);

}  // namespace contactcheck::gate
