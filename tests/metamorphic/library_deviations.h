// Where the answers of reference libraries change although the question is only put differently.
#pragma once

#include <vector>

#include "tests/conformance/known_deviations.h"

namespace contactcheck::test {

/// In the place of cases stand the names of relations.
const std::vector<KnownDeviation>& library_deviations();

}  // namespace contactcheck::test
