// Ratios of times out of results, and whether two runs may be compared by them.
#pragma once

#include <string>

#include "reference/gate/policy.h"
#include "reference/gate/verdict.h"
#include "reference/results/results.h"

namespace contactcheck {

/// Why times of one run say nothing about those of the other: another CPU, number of cores,
/// instruction set, compiler, build, or version of a library. Empty when they do.
std::string other_machine(const results::Results& now, const results::Results& before);

/// Verdict, what was measured and why. `before`: the baseline, or null.
/// @pre not null where needs_baseline(rule); the rule is a timing rule; the row's status is `ok`
Check judge_timing(const Rule& rule, const results::Index& now, const results::Index* before,
                   const results::Run& row);

}  // namespace contactcheck
