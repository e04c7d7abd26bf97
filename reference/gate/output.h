// The gate's answer: for a person on one screen, as JUnit XML, and for GitHub Actions.
#pragma once

#include <string>

#include "reference/gate/verdict.h"

namespace contactcheck::gate {

/// Each broken rule with what was measured and allowed, where, and the command that shows it again;
/// then what was too noisy and what cannot be judged; long lists shortened, with a count of what is
/// left out.
std::string gate_screen(const GateResult& result, bool color);

/// One test suite per rule and one test case per rule, scene and detector; what cannot be judged or
/// is too noisy is `skipped`, unless the policy makes it a failure. No times: none were measured.
std::string junit_xml(const GateResult& result);

/// `text` for an attribute or an element's text; characters that XML cannot hold become '?'.
std::string xml_escaped(const std::string& text);

/// A GitHub workflow command on its line. `kind` is error, warning or notice; the other two may
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
