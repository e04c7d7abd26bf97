// The gate's answer for GitHub Actions: annotations and a job summary.
#pragma once

#include <string>

#include "reference/gate/verdict.h"

namespace contactcheck::gate {

/// A workflow command in a line of its own. `kind` is error, warning or notice; the other two may
/// hold anything.
std::string github_annotation(const std::string& kind, const std::string& title,
                              const std::string& message);

/// Workflow commands, one a line: `error` for what makes the gate red, `warning` for what is too
/// noisy, `notice` for what cannot be judged, by rule. GitHub shows ten of a kind per step: of
/// more, the tenth says how many are left out.
std::string github_annotations(const GateResult& result);

/// Markdown for $GITHUB_STEP_SUMMARY: the counts, a table of what makes the gate red, a list of
/// what was left open.
std::string github_summary(const GateResult& result);

}  // namespace contactcheck::gate
