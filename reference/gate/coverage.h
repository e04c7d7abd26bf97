// What a gate would pass over in silence: rules that match nothing, and what a run has lost since
// its baseline.
#pragma once

#include <string>
#include <vector>

#include "reference/gate/policy.h"
#include "reference/gate/verdict.h"
#include "reference/results/results.h"

namespace contactcheck {

/// The name under which checks against the baseline's rows stand, beside the rules.
inline constexpr const char* kBaselineRule = "everything that the baseline has";

struct RowName {
  std::string scene, detector;
};

/// A failure for every pattern of the rule that stands for none of `rows`, which are those that the
/// rule is about; one failure for a rule without any row.
std::vector<Check> idle_patterns(const Rule& rule, const std::vector<RowName>& rows);

/// A failure for every scene and every row of the baseline that the results lack, and for every row
/// that ended well in the baseline and does not now.
std::vector<Check> lost_rows(const results::Index& now, const results::Results& before);

}  // namespace contactcheck
