// The gate's answer as JUnit XML, which CI systems show.
#pragma once

#include <string>

#include "reference/gate/verdict.h"

namespace contactcheck::gate {

/// One test suite per rule and one test case per rule, scene and detector; what cannot be judged or
/// is too noisy is `skipped`, unless the policy makes it a failure. No times: none were measured.
std::string junit_xml(const GateResult& result);

/// `text` for an attribute or an element's text; characters that XML cannot hold become '?'.
std::string xml_escaped(const std::string& text);

}  // namespace contactcheck::gate
