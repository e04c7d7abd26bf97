// What a suite hoped to measure, beside what it measured.
#pragma once

#include <vector>

#include "reference/results/results.h"

namespace contactcheck::suite {

/// One entry per goal: what was measured, with its interval where it has one, in "x" or "us"; or
/// why it could not be.
std::vector<results::MeasuredGoal> measure_goals(const std::vector<results::Goal>& goals,
                                                 const results::Results& results);

}  // namespace contactcheck::suite
