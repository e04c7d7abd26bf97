// Where a result was measured.
#pragma once

#include "reference/results/results.h"

namespace contactcheck::suite {

results::Machine describe_machine();

}  // namespace contactcheck::suite
