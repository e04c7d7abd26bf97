// The gate's answer for a person, on one screen.
#pragma once

#include <string>

#include "reference/gate/verdict.h"

namespace contactcheck::gate {

/// Each broken rule with what was measured and allowed, where, and the command that shows it again;
/// then what was too noisy and what cannot be judged; long lists shortened, with a count of what is
/// left out.
std::string gate_screen(const GateResult& result, bool color);

}  // namespace contactcheck::gate
