// The middle of measured values.
#pragma once

#include <vector>

namespace contactcheck {

/// The value in the middle; of an even number, the mean of the two there.
/// @pre not empty, no NaN
double median(std::vector<double> values);

}  // namespace contactcheck
