// Those for whom every relation must hold: the exact detectors, and the oracle in their place.
#pragma once

#include <string>
#include <vector>

#include "tests/metamorphic/check.h"

namespace contactcheck::test {

/// Names of detectors, and "oracle" where the relation does not ask it about its own answers.
std::vector<std::string> exact_ones(const Relation& relation);

/// Against the truth; of the oracle, against what it says about the plain frames.
Outcome outcome_of(const std::string& name, const Relation& relation, RelationCase& relation_case);

/// Runs what is registered; 1 where that, or what the filter leaves of it, is no test at all.
int run_registered_tests();

}  // namespace contactcheck::test
