// Rules about answers, not times; these are judged on any machine.
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

/// The same for a scene with random pairs and a rule about oracle_wrong.
Check judge_oracle(const Rule& rule, const results::Scene& scene);

/// The level that a rule looks at in this row: the rule's, or the finest claimed and judged; none
/// if the row was judged at no level.
std::optional<Level> level_of(const Rule& rule, const results::Run& row);

/// "cannot judge", with a reason.
Check cannot_judge(const Rule& rule, const std::string& reason);

/// The baseline's row of the same scene and detector if its status is `ok`; else null, and `reason`
/// says why.
const results::Run* row_before(const results::Index& before, const results::Run& row,
                               std::string& reason);

}  // namespace contactcheck::gate
