// The gate's result: for a person on one screen, as JUnit XML, and for GitHub Actions.
#pragma once

#include <string>

#include "reference/gate/verdict.h"

namespace contactcheck::gate {

/// Each broken rule with measured and allowed value, place, and the command that shows it; then
/// what was too noisy and what could not be judged. Long lists are shortened, with the number left
/// out.
std::string gate_screen(const GateResult& result, bool color);

/// One test suite per rule and one test case per rule, scene and detector. What cannot be judged or
/// is too noisy is `skipped`, unless the policy makes it a failure. There are no times.
std::string junit_xml(const GateResult& result);

/// `text` escaped for an attribute or element; characters that XML does not allow become '?'.
std::string xml_escaped(const std::string& text);

/// A GitHub workflow command on one line. `kind` is error, warning or notice; the other two are
/// escaped.
std::string github_annotation(const std::string& kind, const std::string& title,
                              const std::string& message);

/// Workflow commands, one a line: `error` for failures, `warning` for what is too noisy, `notice`
/// for what cannot be judged, one per rule. GitHub shows ten of a kind per step; if there are more,
/// the tenth gives the number left out.
std::string github_annotations(const GateResult& result);

/// Markdown for $GITHUB_STEP_SUMMARY: the counts, a table of the failures, a list of what was left
/// open.
std::string github_summary(const GateResult& result);

}  // namespace contactcheck::gate
